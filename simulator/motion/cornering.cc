#include "simulator/motion/cornering.h"

#include <algorithm>
#include <cmath>

namespace aisle::sim {
namespace {

constexpr double kSlower = 0.9;
constexpr int kMostSlowdowns = 13;  ///< 0.9^13: a quarter

double CornerSpeed(const DriveCorner& corner, const RouteLimits& limits) {
  if (corner.radius_m <= 0) return corner.cruise_mps;
  return std::min({corner.cruise_mps, std::sqrt(limits.lateral_acceleration_mps2 * corner.radius_m),
                   limits.turn_rate_rad_s * corner.radius_m});
}

/// At constant speed v the curvature changes by v, the turn rate by v^2, the lateral acceleration
/// by v^3 times the sharpness a second.
double SharpnessAt(double speed, const RouteLimits& limits) {
  return std::min({limits.curvature_rate_per_m_s / speed,
                   limits.lateral_jerk_mps3 / (speed * speed * speed),
                   limits.steered_curvature_rate_per_m_s / speed,
                   limits.driven_turn_acceleration_rad_s2 / (speed * speed)});
}

double FollowedSpeed(double sharpness_per_m2, const RouteLimits& limits) {
  return std::min(limits.steered_curvature_rate_per_m_s / sharpness_per_m2,
                  std::sqrt(limits.driven_turn_acceleration_rad_s2 / sharpness_per_m2));
}

/// Which corners are at an end of a side that is too short for them.
std::vector<bool> Crowded(const std::vector<Waypoint>& waypoints, const Sides& sides) {
  std::vector<bool> crowded(waypoints.size());
  const auto tangent = [&](std::size_t i) {
    const Waypoint& waypoint = waypoints[i];
    return ShapeCorner(sides.turns_rad[i], waypoint.corner_radius_m, waypoint.sharpness_per_m2)
        .tangent_m;
  };
  for (std::size_t i = 0; i < sides.lengths_m.size(); ++i) {
    if (tangent(i) + tangent(i + 1) > sides.lengths_m[i]) crowded[i] = crowded[i + 1] = true;
  }
  return crowded;
}

}  // namespace

Cornering TakeCorners(const std::vector<DriveCorner>& corners, const RouteLimits& limits) {
  std::vector<Eigen::Vector2d> points;
  Cornering taken;
  for (const DriveCorner& corner : corners) {
    const double speed = CornerSpeed(corner, limits);
    points.push_back(corner.position);
    taken.speeds_mps.push_back(speed);
    taken.waypoints.push_back({corner.position, corner.radius_m, SharpnessAt(speed, limits)});
  }
  const Sides sides = SidesOf(points);
  taken.followed_mps.assign(corners.size(), std::numeric_limits<double>::infinity());
  if (!std::isfinite(SharpnessAt(1, limits))) return taken;  // arcs at any speed
  for (int slowdown = 0; slowdown < kMostSlowdowns; ++slowdown) {
    const std::vector<bool> crowded = Crowded(taken.waypoints, sides);
    if (std::ranges::count(crowded, true) == 0) break;
    for (std::size_t i = 0; i < crowded.size(); ++i) {
      if (!crowded[i]) continue;
      taken.speeds_mps[i] *= kSlower;
      taken.waypoints[i].sharpness_per_m2 = SharpnessAt(taken.speeds_mps[i], limits);
    }
  }
  constexpr double kRounding = 1e-9;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double followed = FollowedSpeed(taken.waypoints[i].sharpness_per_m2, limits);
    const double by_radius = CornerSpeed(corners[i], limits);
    if (followed <= by_radius * (1 + kRounding)) taken.followed_mps[i] = followed;
  }
  return taken;
}

}  // namespace aisle::sim
