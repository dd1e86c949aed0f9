#include "simulator/motion/path.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace aisle::sim {
namespace {

constexpr double kShortest_m = 1e-6;

/// How a corner is rounded: where the arc begins and ends, measured back from the corner.
struct Corner {
  double turn_rad = 0;   ///< change of heading, positive to the left
  double tangent_m = 0;  ///< distance from the corner to each end of the arc
};

double HeadingOf(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

Corner RoundCorner(double heading_in, double heading_out, double radius_m, std::size_t index) {
  const double turn = WrapAngle(heading_out - heading_in);
  if (std::abs(turn) > 0.999 * std::numbers::pi) {
    throw std::invalid_argument(
        fmt::format("waypoint {}: the path turns straight back on itself", index));
  }
  return {turn, std::abs(radius_m * std::tan(turn / 2))};
}

PathPoint Along(const PathPoint& start, double distance) {
  const double k = start.curvature_per_m;
  const double half = k * distance / 2;
  // The chord of an arc: length s·sinc(ks/2), direction half-way through the turn.
  const double chord = std::abs(half) < 1e-9 ? distance : distance * std::sin(half) / half;
  const double direction = start.heading_rad + half;
  return {start.position + chord * Eigen::Vector2d(std::cos(direction), std::sin(direction)),
          start.heading_rad + k * distance, k};
}

}  // namespace

double WrapAngle(double angle) {
  const double turns = std::ceil((angle - std::numbers::pi) / (2 * std::numbers::pi));
  return angle - turns * 2 * std::numbers::pi;
}

void Path::Append(const PathPoint& start, double length, std::size_t side) {
  if (length < kShortest_m) return;
  segments_.push_back({length_m_, length, start, static_cast<int>(side)});
  length_m_ += length;
}

Path Path::Through(std::span<const Waypoint> waypoints) {
  if (waypoints.size() < 2) throw std::invalid_argument("a path needs at least two points");
  const std::size_t sides = waypoints.size() - 1;
  std::vector<double> lengths(sides), headings(sides);
  for (std::size_t i = 0; i < sides; ++i) {
    const Eigen::Vector2d side = waypoints[i + 1].position - waypoints[i].position;
    lengths[i] = side.norm();
    if (lengths[i] < kShortest_m) {
      throw std::invalid_argument(
          fmt::format("waypoint {}: it is at the same place as the one before", i + 1));
    }
    headings[i] = HeadingOf(side);
  }
  std::vector<Corner> corners(waypoints.size());  // the ends stay straight
  for (std::size_t i = 1; i < sides; ++i) {
    corners[i] = RoundCorner(headings[i - 1], headings[i], waypoints[i].corner_radius_m, i);
  }
  Path path;
  double heading = headings[0];  // accumulated, never wrapped, so that it is continuous
  for (std::size_t i = 0; i < sides; ++i) {
    const double straight = lengths[i] - corners[i].tangent_m - corners[i + 1].tangent_m;
    if (straight < -kShortest_m) {
      throw std::invalid_argument(fmt::format(
          "waypoint {}: a corner radius of {:g} m does not fit: the side before it is {:.3g} m "
          "long, its corners need {:.3g} m",
          i + 1, waypoints[i + 1].corner_radius_m, lengths[i],
          corners[i].tangent_m + corners[i + 1].tangent_m));
    }
    const Eigen::Vector2d along(std::cos(headings[i]), std::sin(headings[i]));
    path.Append({waypoints[i].position + corners[i].tangent_m * along, heading, 0}, straight, i);
    const Corner& corner = corners[i + 1];
    if (corner.tangent_m > kShortest_m) {
      const double radius = waypoints[i + 1].corner_radius_m;
      path.Append({waypoints[i + 1].position - corner.tangent_m * along, heading,
                   std::copysign(1 / radius, corner.turn_rad)},
                  radius * std::abs(corner.turn_rad), i);
    }
    heading += corner.turn_rad;
  }
  return path;
}

PathPoint Path::At(double distance_m) const {
  const double distance = std::clamp(distance_m, 0.0, length_m_);
  const auto after = std::upper_bound(
      segments_.begin() + 1, segments_.end(), distance,
      [](double value, const Segment& segment) { return value < segment.start_m; });
  const Segment& segment = *std::prev(after);
  return Along(segment.start, std::min(distance - segment.start_m, segment.length_m));
}

}  // namespace aisle::sim
