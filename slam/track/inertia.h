#pragma once

#include <optional>

#include "slam/camera/measured_motion.h"
#include "slam/track/track_options.h"

namespace aisle::slam {

/// The rig's velocity as its poses tell it.
struct Velocity {
  /// Of T_rig_world, see Retract: translation (m/s), then rotation (rad/s).
  Vector6d per_second = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();  ///< of per_second, in the same order
};

/// Where it carries the rig within so many seconds.
MeasuredMotion Carry(const Velocity& velocity, double seconds, const InertiaOptions& options);

/// The velocity after so many seconds of which nothing is known but that.
Velocity Coasted(const Velocity& velocity, double seconds, const InertiaOptions& options);

/// The velocity after a step (Kalman filter, constant velocity). A step that no vehicle can take
/// teaches nothing. `before`: nothing where the step is the first.
Velocity Learn(const std::optional<Velocity>& before, const MeasuredMotion& step, double seconds,
               const InertiaOptions& options);

}  // namespace aisle::slam
