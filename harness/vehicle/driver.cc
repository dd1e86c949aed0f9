#include "harness/vehicle/driver.h"

#include <fmt/format.h>

#include <algorithm>

namespace aisle {
namespace {

constexpr double kStanding_mps = 0.004, kStanding_rad_s = 0.004;

bool Stands(const DriverInput& input) {
  return std::abs(input.speed_mps) < kStanding_mps &&
         std::abs(input.turn_rate_rad_s) < kStanding_rad_s;
}

/// The speed with which the end that lies `left_m` ahead can still be met: gently over the last
/// stretch, so that lag and late poses cost millimetres.
double SpeedBefore(double left_m, const DriverOptions& options) {
  if (left_m <= 0) return 0;
  const double gentle = std::min(left_m, options.docking_m);
  const double rest = left_m - gentle;
  return std::max(options.creep_mps,
                  std::sqrt(2 * options.docking_mps2 * gentle + 2 * options.braking_mps2 * rest));
}

/// Curvature of travel towards the way by the law.
double CurvatureBy(const WayLeg& leg, const OnWay& at, const FloorPose& travel, double speed_mps,
                   const DriverOptions& options) {
  if (options.law == SteeringLaw::kKanayama) {
    const double theta = WrapAngle(at.heading_rad - travel.heading_rad);
    // The way's bend where the actuators will have followed.
    const double bend = PointAt(leg, at.distance_m + speed_mps * options.lag_s).curvature_per_m;
    return bend - options.k_y_per_m2 * at.cross_track_m + options.k_theta_per_m * std::sin(theta);
  }
  const double ahead =
      std::clamp(options.lookahead_s * speed_mps, options.lookahead_min_m, options.lookahead_max_m);
  const Eigen::Vector2d target = PointAt(leg, at.distance_m + ahead).position;
  const Eigen::Vector2d local = travel.inverse() * target;
  return 2 * local.y() / std::max(local.squaredNorm(), 1e-4);
}

DriverStep NextLeg(DriverState state, const Way& way) {
  state.leg = std::min(state.leg + 1, way.size());
  state.on_leg_m = state.paused_s = 0;
  state.arrived = state.leg >= way.size();
  return {state, {}};
}

DriverStep DriveLeg(const Way& way, DriverState state, const DriverInput& input,
                    const DriverOptions& options) {
  const WayLeg& leg = way[state.leg];
  const double back = leg.reverse ? std::numbers::pi : 0;
  const FloorPose travel{input.belief.position, input.belief.heading_rad + back};
  const double speed_now = std::abs(input.speed_mps);
  const OnWay at = Nearest(leg, travel.position, state.on_leg_m);
  // A leg's start may not be left backwards, nor its progress lost when the belief jumps a little.
  state.on_leg_m = std::clamp(at.distance_m, 0.0, leg.length_m());
  // Actuators follow late: what they do now is felt a lag further on.
  const double ahead_m = speed_now * options.lag_s;
  const double left_m = leg.length_m() - at.distance_m - ahead_m;
  if (left_m <= options.arrive_m) {
    return Stands(input) ? NextLeg(state, way) : DriverStep{state, {}};
  }
  double speed =
      std::min(PointAt(leg, at.distance_m + ahead_m).speed_mps, SpeedBefore(left_m, options));
  if (input.degraded) speed = std::min(speed, options.degraded_mps);
  const double curvature = CurvatureBy(leg, at, travel, speed_now, options);
  DriveCommand command;
  command.speed_mps = leg.reverse ? -speed : speed;
  command.turn_rate_rad_s = curvature * speed;
  return {state, command};
}

DriverStep TurnLeg(const Way& way, const DriverState& state, const DriverInput& input,
                   const DriverOptions& options) {
  const double lag = input.turn_rate_rad_s * options.lag_s;
  // Both headings go on beyond half a turn: which way to turn is the plan's, also for half a turn.
  const double left = way[state.leg].turn_to_rad - input.belief.heading_rad - lag;
  if (std::abs(left) <= options.turn_arrive_rad) {
    return Stands(input) ? NextLeg(state, way) : DriverStep{state, {}};
  }
  constexpr double kSlowest_rad_s = 0.01;
  double rate = std::clamp(std::sqrt(2 * options.turn_braking_rad_s2 * std::abs(left)) / 2,
                           kSlowest_rad_s, options.turn_rate_rad_s);
  if (input.degraded) rate = std::min(rate, options.degraded_mps / options.reach_m);
  return {state, {.speed_mps = 0, .turn_rate_rad_s = left < 0 ? -rate : rate}};
}

}  // namespace

std::string DriverOptions::Validate() const {
  for (const auto& [name, value] :
       {std::pair("lookahead_s", lookahead_s), std::pair("lookahead_min_m", lookahead_min_m),
        std::pair("k_y_per_m2", k_y_per_m2), std::pair("k_theta_per_m", k_theta_per_m),
        std::pair("braking_mps2", braking_mps2), std::pair("docking_mps2", docking_mps2),
        std::pair("docking_m", docking_m), std::pair("creep_mps", creep_mps),
        std::pair("arrive_m", arrive_m), std::pair("turn_arrive_rad", turn_arrive_rad),
        std::pair("turn_rate_rad_s", turn_rate_rad_s),
        std::pair("turn_braking_rad_s2", turn_braking_rad_s2),
        std::pair("degraded_mps", degraded_mps), std::pair("reach_m", reach_m)}) {
    if (!(std::isfinite(value) && value > 0)) {
      return fmt::format("{} is {}, it must be more than 0", name, value);
    }
  }
  if (lookahead_max_m < lookahead_min_m) {
    return fmt::format("lookahead_max_m is {}, less than lookahead_min_m, {}", lookahead_max_m,
                       lookahead_min_m);
  }
  return "";
}

Way Prepare(const Way& way, const DriverOptions& options) {
  Way prepared;
  for (const WayLeg& leg : way) prepared.push_back(WithBraking(leg, options.braking_mps2));
  return prepared;
}

DriverStep DriveAlong(const Way& way, const DriverState& state, const DriverInput& input,
                      const DriverOptions& options) {
  if (state.leg >= way.size()) {
    DriverState arrived = state;
    arrived.arrived = true;
    return {arrived, {}};
  }
  const WayLeg& leg = way[state.leg];
  if (leg.kind == WayLeg::Kind::kDrive) return DriveLeg(way, state, input, options);
  if (leg.kind == WayLeg::Kind::kTurn) return TurnLeg(way, state, input, options);
  DriverState waiting = state;
  waiting.paused_s += input.duration_s;
  if (waiting.paused_s + 1e-9 >= leg.duration_s) return NextLeg(waiting, way);
  return {waiting, {}};
}

}  // namespace aisle
