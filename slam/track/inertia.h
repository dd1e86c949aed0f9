#pragma once

#include <optional>

#include "slam/camera/measured_motion.h"
#include "slam/common/option_fields.h"

namespace aisle::slam {

/// What a vehicle's mass says of its motion: it goes on as it went.
struct InertiaOptions {
  /// Deviation of the acceleration, that of a frame independent of the last one's.
  double acceleration_mps2 = 1.5;
  double angular_acceleration_radps2 = 3;
  /// Of the difference between a pose found and the one expected, over its covariance; 99.99 % with
  /// six degrees of freedom. Beyond it the vehicle cannot have got there.
  double most_chi2 = 27.86;
  double longest_s = 1;  ///< for which a pose is believed that nothing but inertia tells of
};
void Describe(OptionFields& fields, InertiaOptions& options);

/// The rig's velocity as its poses tell it.
struct Velocity {
  Vector6d per_second = Vector6d::Zero();  ///< of T_rig_world; see Retract
  Matrix6d covariance = Matrix6d::Zero();
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
