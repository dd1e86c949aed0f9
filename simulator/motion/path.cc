#include "simulator/motion/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace aisle::sim {
namespace {

/// Lines shorter than this, between corners that just fit, are left out.
constexpr double kShortest_m = 1e-6;

std::vector<CornerShape> ShapesOf(std::span<const Waypoint> waypoints, const Sides& sides) {
  std::vector<CornerShape> shapes(waypoints.size());  // the ends stay straight
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    shapes[i] = ShapeCorner(sides.turns_rad[i], waypoints[i].corner_radius_m,
                            waypoints[i].sharpness_per_m2);
  }
  return shapes;
}

}  // namespace

/// Where the segment ends.
PathPoint Path::Append(const PathPoint& start, double sharpness, double length, std::size_t side) {
  if (length <= 0) return start;
  segments_.push_back({length_m_, length, start, sharpness, static_cast<int>(side)});
  length_m_ += length;
  return AlongClothoid(start, sharpness, length);
}

void Path::AppendCorner(PathPoint start, const CornerShape& shape, std::size_t side) {
  const double sharpness = std::copysign(shape.sharpness_per_m2, shape.turn_rad);
  const double curvature = std::copysign(shape.curvature_per_m, shape.turn_rad);
  PathPoint now = Append(start, sharpness, shape.ramp_m, side);
  now.curvature_per_m = curvature;
  now = Append(now, 0, shape.arc_m, side);
  Append(now, -sharpness, shape.ramp_m, side);
}

Path Path::Through(std::span<const Waypoint> waypoints) {
  std::vector<Eigen::Vector2d> points;
  for (const Waypoint& waypoint : waypoints) points.push_back(waypoint.position);
  const Sides sides = SidesOf(points);
  const std::vector<CornerShape> corners = ShapesOf(waypoints, sides);
  Path path;
  double heading = sides.headings_rad[0];  // accumulated, never wrapped, so that it is continuous
  for (std::size_t i = 0; i < sides.lengths_m.size(); ++i) {
    const CornerShape &before = corners[i], &after = corners[i + 1];
    const double straight = sides.lengths_m[i] - before.tangent_m - after.tangent_m;
    if (straight < -kShortest_m) {
      throw std::invalid_argument(fmt::format(
          "waypoint {}: a corner radius of {:g} m does not fit: the side before it is {:.3g} m "
          "long, its corners need {:.3g} m",
          i + 1, waypoints[i + 1].corner_radius_m, sides.lengths_m[i],
          before.tangent_m + after.tangent_m));
    }
    const Eigen::Vector2d along(std::cos(sides.headings_rad[i]), std::sin(sides.headings_rad[i]));
    if (straight >= kShortest_m) {
      path.Append({waypoints[i].position + before.tangent_m * along, heading, 0}, 0, straight, i);
    }
    path.AppendCorner({waypoints[i + 1].position - after.tangent_m * along, heading, 0}, after, i);
    heading += after.turn_rad;
  }
  return path;
}

Path Path::OfArcs(PathPoint start, std::span<const Arc> arcs) {
  Path path;
  for (const Arc& arc : arcs) {
    start.curvature_per_m = arc.curvature_per_m;
    start = path.Append(start, 0, arc.length_m, path.segments_.size());
  }
  return path;
}

PathPoint Path::At(double distance_m) const {
  const double distance = std::clamp(distance_m, 0.0, length_m_);
  const auto after = std::upper_bound(
      segments_.begin() + 1, segments_.end(), distance,
      [](double value, const Segment& segment) { return value < segment.start_m; });
  const Segment& segment = *std::prev(after);
  return AlongClothoid(segment.start, segment.sharpness_per_m2,
                       std::min(distance - segment.start_m, segment.length_m));
}

}  // namespace aisle::sim
