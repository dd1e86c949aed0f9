#pragma once

#include <Eigen/Geometry>
#include <span>

#include "simulator/motion/route.h"

namespace aisle::sim {

/// Where the left camera sits on its vehicle.
struct RigMount {
  double height_m = 0.8;   ///< above the floor
  double forward_m = 0.3;  ///< ahead of the point the route moves
  double pitch_rad = 0;    ///< positive looks down
  double left_m = 0;       ///< beside that point
  double yaw_rad = 0;      ///< positive looks to the left
  double roll_rad = 0;     ///< positive lowers its right side
};

/// A jolt of the vehicle: a damped swing in height and pitch.
struct Bump {
  double at_s = 0;
  double height_m = 0.01;
  double pitch_rad = 0.01;
  double frequency_hz = 4;
  double decay_s = 0.25;
};

/// The camera's turn against its vehicle, level and ahead being none: yaw, then pitch, then roll,
/// each about the axes as turned so far (camera axes: x right, y down, z forward).
Eigen::Matrix3d MountTurn(const RigMount& mount);

/// T_world_rig of a vehicle whose route is at `state`. Camera axes: x right, y down, z forward.
Eigen::Isometry3d RigPose(const RouteState& state, const RigMount& mount,
                          std::span<const Bump> bumps, double time_s);

}  // namespace aisle::sim
