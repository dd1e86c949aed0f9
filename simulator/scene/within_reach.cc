#include "simulator/scene/within_reach.h"

#include <algorithm>
#include <numbers>

namespace aisle::sim {
namespace {

constexpr double kAcross_rad = 89.9 * std::numbers::pi / 180;

/// Its one wheel is w away from the axle: it steers there, and drives the turn by its own speed.
RouteLimits OfTricycle(RouteLimits limits, const DriveSpec& drive) {
  const double speeding_up = std::min(drive.acceleration_mps2, drive.braking_mps2);
  limits.turns_on_the_spot = limits.turns_on_the_spot && drive.max_steering_rad >= kAcross_rad;
  limits.turn_rate_rad_s =
      std::min(limits.turn_rate_rad_s, drive.max_speed_mps / drive.wheelbase_m);
  limits.turn_acceleration_rad_s2 =
      std::min(limits.turn_acceleration_rad_s2, speeding_up / drive.wheelbase_m);
  // The curvature is tan(steering) / wheelbase, which changes least where the wheel looks ahead: as
  // a corner begins.
  limits.steered_curvature_rate_per_m_s = drive.steering_rate_rad_s / drive.wheelbase_m;
  return limits;
}

RouteLimits OfDifferential(RouteLimits limits, const DriveSpec& drive) {
  limits.turn_acceleration_rad_s2 =
      std::min(limits.turn_acceleration_rad_s2, drive.turn_acceleration_rad_s2);
  limits.driven_turn_acceleration_rad_s2 = drive.turn_acceleration_rad_s2;
  return limits;
}

}  // namespace

RouteSpec WithinReach(RouteSpec route, const DriveSpec& drive) {
  RouteLimits& limits = route.limits;
  limits.acceleration_mps2 =
      std::min({limits.acceleration_mps2, drive.acceleration_mps2, drive.braking_mps2});
  limits.turn_rate_rad_s = std::min(limits.turn_rate_rad_s, drive.turn_rate_rad_s);
  limits = drive.kind == DriveKind::kTricycle ? OfTricycle(limits, drive)
                                              : OfDifferential(limits, drive);
  for (RouteStep& step : route.plan.steps) {
    step.speed_mps = std::min(step.speed_mps, drive.max_speed_mps);
  }
  return route;
}

}  // namespace aisle::sim
