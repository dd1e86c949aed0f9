#include "simulator/motion/corner.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "simulator/motion/clothoid.h"

namespace aisle::sim {
namespace {

constexpr double kShortestSide_m = 1e-6;
/// Turns so slight are driven straight through.
constexpr double kStraight_rad = 1e-9;

/// From the corner back to where clothoids leave its line: the curve is its own mirror image about
/// the bisector, so that follows from where it is half-way through the turn.
double TangentOfRamps(const CornerShape& shape) {
  const double half = std::abs(shape.turn_rad) / 2;
  const PathPoint ramp = AlongClothoid({}, shape.sharpness_per_m2, shape.ramp_m);
  const PathPoint middle = AlongClothoid(ramp, 0, shape.arc_m / 2);
  return middle.position.x() + middle.position.y() * std::tan(half);
}

}  // namespace

double WrapAngle(double angle) {
  const double turns = std::ceil((angle - std::numbers::pi) / (2 * std::numbers::pi));
  return angle - turns * 2 * std::numbers::pi;
}

CornerShape ShapeCorner(double turn_rad, double radius_m, double sharpness_per_m2) {
  CornerShape shape;
  shape.turn_rad = turn_rad;
  const double turn = std::abs(turn_rad);
  if (turn < kStraight_rad || radius_m <= 0) return shape;
  shape.curvature_per_m = 1 / radius_m;
  shape.arc_m = radius_m * turn;
  shape.tangent_m = std::abs(radius_m * std::tan(turn_rad / 2));
  if (std::isfinite(sharpness_per_m2)) {
    // Each clothoid turns by half its end's curvature times its length.
    const double reachable = std::sqrt(turn * sharpness_per_m2);
    if (reachable < shape.curvature_per_m) shape.curvature_per_m = reachable;
    shape.sharpness_per_m2 = sharpness_per_m2;
    shape.ramp_m = shape.curvature_per_m / sharpness_per_m2;
    shape.arc_m = std::max(0.0, turn / shape.curvature_per_m - shape.ramp_m);
    shape.tangent_m = TangentOfRamps(shape);
  }
  return shape;
}

Sides SidesOf(const std::vector<Eigen::Vector2d>& points) {
  if (points.size() < 2) throw std::invalid_argument("a path needs at least two points");
  Sides sides;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d side = points[i + 1] - points[i];
    if (side.norm() < kShortestSide_m) {
      throw std::invalid_argument(
          fmt::format("waypoint {}: it is at the same place as the one before", i + 1));
    }
    sides.lengths_m.push_back(side.norm());
    sides.headings_rad.push_back(std::atan2(side.y(), side.x()));
  }
  sides.turns_rad.assign(points.size(), 0.0);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    sides.turns_rad[i] = WrapAngle(sides.headings_rad[i] - sides.headings_rad[i - 1]);
    if (std::abs(sides.turns_rad[i]) > 0.999 * std::numbers::pi) {
      throw std::invalid_argument(
          fmt::format("waypoint {}: the path turns straight back on itself", i));
    }
  }
  return sides;
}

}  // namespace aisle::sim
