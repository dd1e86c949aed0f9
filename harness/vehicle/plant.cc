#include "harness/vehicle/plant.h"

#include <fmt/format.h>

#include <algorithm>

namespace aisle {
namespace {

constexpr double kStraight_rad = 1e-9;
constexpr double kStands_mps = 0.01;
constexpr double kSetOff_rad = 5 * std::numbers::pi / 180;

/// Braking and speeding up have limits of their own.
double RateTowards(double from, double target, const PlantOptions& options, bool protective) {
  const bool brakes = from * target < 0 || std::abs(target) < std::abs(from);
  if (!brakes) return options.acceleration_mps2;
  return protective ? options.stop_mps2 : options.braking_mps2;
}

PlantStep MoveDifferential(const PlantState& from, const DriveCommand& command, double duration_s,
                           const PlantOptions& options) {
  const double speed = std::clamp(command.protective_stop ? 0 : command.speed_mps,
                                  -options.max_speed_mps, options.max_speed_mps);
  const double turn = std::clamp(command.protective_stop ? 0 : command.turn_rate_rad_s,
                                 -options.max_turn_rate_rad_s, options.max_turn_rate_rad_s);
  const LagStep drive = FollowWithLag(
      from.speed_mps, speed, options.lag_s,
      RateTowards(from.speed_mps, speed, options, command.protective_stop), duration_s);
  const LagStep yaw = FollowWithLag(from.turn_rate_rad_s, turn, options.lag_s,
                                    options.turn_acceleration_rad_s2, duration_s);
  PlantStep step;
  step.way_m = drive.integral;
  step.turn_rad = yaw.integral;
  step.state.speed_mps = drive.end;
  step.state.turn_rate_rad_s = yaw.end;
  return step;
}

/// FollowWithLag to 0, integrated: a ramp, and the lag's fading once that is slower.
double UntilRest(double from, double rate, double lag_s) {
  const double faded = std::min(from, rate * lag_s);
  return (from * from - faded * faded) / (2 * rate) + faded * lag_s;
}

/// The steering angle that a command asks for; one that asks for nothing leaves it alone.
double SteeringFor(const DriveCommand& command, double now_rad, const PlantOptions& options) {
  const double across = options.wheelbase_m * command.turn_rate_rad_s;
  if (command.protective_stop || (command.speed_mps == 0 && across == 0)) return now_rad;
  const double angle = command.speed_mps < 0 ? std::atan2(-across, -command.speed_mps)
                                             : std::atan2(across, command.speed_mps);
  return std::clamp(angle, -options.max_steering_rad, options.max_steering_rad);
}

PlantStep MoveTricycle(const PlantState& from, const DriveCommand& command, double duration_s,
                       const PlantOptions& options) {
  const double angle = SteeringFor(command, from.steering_rad, options);
  const LagStep steer = FollowWithLag(from.steering_rad, angle, options.lag_s,
                                      options.steering_rate_rad_s, duration_s);
  const double sign = command.speed_mps < 0 ? -1 : 1;
  double wheel =
      sign * std::hypot(command.speed_mps, options.wheelbase_m * command.turn_rate_rad_s);
  // While the wheel is still turning into its direction it must not push the vehicle elsewhere: who
  // rolls pushes the less for it, who stands or turns on the spot waits.
  const bool waits = command.speed_mps == 0 || std::abs(from.speed_mps) < kStands_mps;
  wheel *= waits && std::abs(angle - steer.end) > kSetOff_rad
               ? 0
               : std::max(0.0, std::cos(angle - from.steering_rad));
  if (command.protective_stop) wheel = 0;
  wheel = std::clamp(wheel, -options.max_speed_mps, options.max_speed_mps);
  const LagStep drive = FollowWithLag(
      from.speed_mps, wheel, options.lag_s,
      RateTowards(from.speed_mps, wheel, options, command.protective_stop), duration_s);
  PlantStep step;
  step.steering_rad = steer.integral / duration_s;
  step.wheel_way_m = drive.integral;
  step.way_m = drive.integral * std::cos(step.steering_rad);
  step.turn_rad = drive.integral * std::sin(step.steering_rad) / options.wheelbase_m;
  step.state.speed_mps = drive.end;
  step.state.steering_rad = steer.end;
  step.state.turn_rate_rad_s = drive.end * std::sin(steer.end) / options.wheelbase_m;
  return step;
}

}  // namespace

std::string PlantOptions::Validate() const {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  for (const auto& [name, value] :
       {std::pair("track_m", track_m), std::pair("wheelbase_m", wheelbase_m),
        std::pair("max_speed_mps", max_speed_mps),
        std::pair("acceleration_mps2", acceleration_mps2), std::pair("braking_mps2", braking_mps2),
        std::pair("stop_mps2", stop_mps2), std::pair("max_turn_rate_rad_s", max_turn_rate_rad_s),
        std::pair("turn_acceleration_rad_s2", turn_acceleration_rad_s2),
        std::pair("max_steering_rad", max_steering_rad),
        std::pair("steering_rate_rad_s", steering_rate_rad_s)}) {
    if (!positive(value)) return fmt::format("{} is {}, it must be more than 0", name, value);
  }
  if (max_steering_rad > std::numbers::pi / 2 + 1e-12) {
    return fmt::format("max_steering_rad is {}, it must be at most pi / 2", max_steering_rad);
  }
  if (!(lag_s >= 0)) return fmt::format("lag_s is {}, it must not be negative", lag_s);
  return "";
}

LagStep FollowWithLag(double from, double target, double lag_s, double rate, double duration_s) {
  const double error = target - from;
  const double sign = error < 0 ? -1 : 1;
  // First as fast as it may, until the lag alone is slower.
  const double ramp_s = std::clamp((std::abs(error) - rate * lag_s) / rate, 0.0, duration_s);
  const double ramped = from + sign * rate * ramp_s;
  LagStep step;
  step.integral = ramp_s * (from + ramped) / 2;
  const double rest_s = duration_s - ramp_s;
  const double left = target - ramped;
  if (lag_s <= 0) {
    // The ramp ends on the target or with the step.
    step.end = rest_s > 0 ? target : ramped;
    step.integral += target * rest_s;
    return step;
  }
  const double fading = std::exp(-rest_s / lag_s);
  step.end = target - left * fading;
  step.integral += target * rest_s - left * lag_s * (1 - fading);
  return step;
}

double StoppingWay(double speed_mps, const PlantOptions& options) {
  return UntilRest(std::abs(speed_mps), options.stop_mps2, options.lag_s);
}

double StoppingTurn(double turn_rate_rad_s, const PlantOptions& options) {
  // A tricycle turns as its driven wheel rolls, and stops as that does.
  const double slowing =
      options.kind == VehicleKind::kTricycle
          ? options.stop_mps2 * std::sin(options.max_steering_rad) / options.wheelbase_m
          : options.turn_acceleration_rad_s2;
  return UntilRest(std::abs(turn_rate_rad_s), slowing, options.lag_s);
}

double TurningRadius(const PlantOptions& options) {
  return options.kind == VehicleKind::kTricycle
             ? options.wheelbase_m / std::tan(options.max_steering_rad)
             : 0;
}

FloorPose AlongArc(const FloorPose& pose, double way_m, double turn_rad) {
  const Eigen::Vector2d chord = std::abs(turn_rad) < kStraight_rad
                                    ? Eigen::Vector2d(way_m, way_m * turn_rad / 2)
                                    : Eigen::Vector2d(way_m * std::sin(turn_rad) / turn_rad,
                                                      way_m * (1 - std::cos(turn_rad)) / turn_rad);
  return pose * FloorPose{chord, turn_rad};
}

PlantStep Move(const PlantState& from, const DriveCommand& command, double duration_s,
               const PlantOptions& options) {
  PlantStep step = options.kind == VehicleKind::kTricycle
                       ? MoveTricycle(from, command, duration_s, options)
                       : MoveDifferential(from, command, duration_s, options);
  step.state.pose = AlongArc(from.pose, step.way_m, step.turn_rad);
  step.state.acceleration_mps2 = (step.state.speed_mps - from.speed_mps) / duration_s;
  return step;
}

}  // namespace aisle
