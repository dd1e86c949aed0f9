#pragma once

#include <cstddef>
#include <string>

#include "harness/contract/steering.h"
#include "harness/vehicle/plant.h"
#include "harness/vehicle/way.h"

namespace aisle {

/// How a driver follows its way.
struct DriverOptions {
  SteeringLaw law = SteeringLaw::kPurePursuit;
  double lookahead_s = 0.7;      ///< pure pursuit: its distance over the speed
  double lookahead_min_m = 0.4;  ///< and its bounds
  double lookahead_max_m = 1.2;
  double k_y_per_m2 = 6;       ///< Kanayama: across
  double k_theta_per_m = 5;    ///< Kanayama: heading; damping is k_theta / (2 sqrt(k_y))
  double braking_mps2 = 0.4;   ///< planned for bends and ends of legs
  double docking_mps2 = 0.12;  ///< over the last docking_m of a leg
  double docking_m = 0.6;
  double creep_mps = 0.02;         ///< slowest before an end
  double arrive_m = 0.001;         ///< a leg's end is reached within this
  double turn_arrive_rad = 0.001;  ///< a turn on the spot too
  double turn_rate_rad_s = 0.8;    ///< on the spot
  double turn_braking_rad_s2 = 0.8;
  /// Fastest without a pose: the axle's middle, or in a turn on the spot what reaches farthest.
  double degraded_mps = 0.3;
  double reach_m = 1;  ///< of the vehicle from its axle's middle
  double lag_s = 0.1;  ///< of the actuators, looked ahead over

  std::string Validate() const;  ///< the first broken rule, or an empty string
};

/// What a driver knows of its vehicle: its own belief, never the truth.
struct DriverInput {
  FloorPose belief;
  double speed_mps = 0;  ///< of the axle's middle by the wheels, backwards negative
  double turn_rate_rad_s = 0;
  bool degraded = false;  ///< no pose to steer by: creep
  double duration_s = 0;  ///< since the last call
};

/// How far a driver is on its way. A plain value.
struct DriverState {
  std::size_t leg = 0;
  double on_leg_m = 0;
  double paused_s = 0;
  bool arrived = false;  ///< the last leg is over
  bool operator==(const DriverState&) const = default;
};

struct DriverStep {
  DriverState state;
  DriveCommand command;
};

/// The way as DriveAlong wants it: bends can be braked for.
Way Prepare(const Way& way, const DriverOptions& options);

/// What the driver does next: a pure function of what it knows. `way` is from Prepare.
DriverStep DriveAlong(const Way& way, const DriverState& state, const DriverInput& input,
                      const DriverOptions& options);

}  // namespace aisle
