#pragma once

#include "harness/contract/floor.h"

namespace aisle {

enum class VehicleKind {
  kDifferential,  ///< two driven wheels on the axle
  kTricycle,      ///< a fixed axle, and ahead of it one wheel that is driven and steered
};

/// What a vehicle can do. The vehicle's frame: x ahead, y left, origin in the middle of the fixed
/// axle.
struct PlantOptions {
  VehicleKind kind = VehicleKind::kDifferential;
  double track_m = 0.5;                   ///< differential: from wheel to wheel
  double wheelbase_m = 0.9;               ///< tricycle: from the axle to the steered wheel
  double max_speed_mps = 1.6;             ///< of the driven wheel, or of the axle's middle
  double acceleration_mps2 = 0.6;         ///< speeding up
  double braking_mps2 = 0.8;              ///< slowing down in service
  double stop_mps2 = 1.6;                 ///< slowing down in a protective stop
  double max_turn_rate_rad_s = 1.05;      ///< differential
  double turn_acceleration_rad_s2 = 3.1;  ///< differential
  double max_steering_rad = 1.3;          ///< tricycle, at most pi / 2
  double steering_rate_rad_s = 1.05;      ///< tricycle
  double lag_s = 0.1;                     ///< time constant of drive and steering; 0: none

  /// The first broken rule with its value, or an empty string.
  std::string Validate() const;
};

struct PlantState {
  FloorPose pose;                ///< true
  double speed_mps = 0;          ///< of the driven wheel (tricycle) or of the axle's middle
  double turn_rate_rad_s = 0;    ///< of the vehicle
  double steering_rad = 0;       ///< tricycle: of the steered wheel, positive to the left
  double acceleration_mps2 = 0;  ///< mean of the last step

  /// Speed of the axle's middle along the heading, backwards negative.
  double AheadSpeed(VehicleKind kind) const {
    return kind == VehicleKind::kTricycle ? speed_mps * std::cos(steering_rad) : speed_mps;
  }
  bool operator==(const PlantState&) const = default;
};

/// What a vehicle is told to do.
struct DriveCommand {
  double speed_mps = 0;  ///< of the axle's middle, backwards negative
  double turn_rate_rad_s = 0;
  bool protective_stop = false;  ///< brake as hard as it may; the speed asked for is 0 then
  bool operator==(const DriveCommand&) const = default;
};

/// What a step of time did.
struct PlantStep {
  PlantState state;
  double way_m = 0;  ///< of the axle's middle along its arc, backwards negative
  double turn_rad = 0;
  double wheel_way_m = 0;   ///< tricycle: of the driven wheel
  double steering_rad = 0;  ///< tricycle: mean over the step
};

/// A quantity that follows its set value with a time constant (0: at once) and a largest rate:
/// value' = clamp((target - value) / lag, -rate, rate), solved in closed form.
struct LagStep {
  double end = 0, integral = 0;
};
LagStep FollowWithLag(double from, double target, double lag_s, double rate, double duration_s);

/// The way on which a protective stop ends, in metres, 0 or more, of a vehicle that goes straight.
double StoppingWay(double speed_mps, const PlantOptions& options);
/// What a protective stop still turns, in radians, of a vehicle that turns on the spot at a rate.
double StoppingTurn(double turn_rate_rad_s, const PlantOptions& options);
/// Way of the axle's middle for each radian that it turns as near to on the spot as it can, in
/// metres, ahead: a steered wheel that cannot stand across pushes the axle on.
double TurningRadius(const PlantOptions& options);

/// The pose after a way along an arc that turns by an angle.
FloorPose AlongArc(const FloorPose& pose, double way_m, double turn_rad);

/// Moves the vehicle for a time under one command. Speeds and steering follow their set values in
/// closed form; the pose goes along the arc of their integrals, which is exact while the curvature
/// is constant and of second order in the step else. A tricycle that stands sets off, and one that
/// is to turn on the spot pushes, once its wheel is within 5 degrees of its direction. duration_s >
/// 0, some milliseconds.
PlantStep Move(const PlantState& from, const DriveCommand& command, double duration_s,
               const PlantOptions& options);

}  // namespace aisle
