#pragma once

#include <vector>

#include "harness/contract/sequence.h"
#include "harness/contract/wheel_track.h"
#include "harness/vehicle/odometry.h"
#include "slam/stereo_slam.h"

namespace aisle {

/// How far a vehicle's wheels and floor leave its motion open, who rolled `way_m` and turned
/// `turn_rad`: of a small motion of the body (x ahead, y left, z up), translation, then rotation.
/// What wheels do not see (it heaves, nods, slips aside) counts once, calibration's errors as if
/// they were drawn anew every 5 m and 3 rad. As the vehicle's kind has it: the difference of two
/// wheels' ways, or the way and the steering angle of one.
slam::Matrix6d RollingCovariance(double way_m, double turn_rad, const OdometryOptions& options,
                                 const PlantOptions& plant);

/// A motion of a body as one of the rig that is mounted on it.
MotionMeasurement OfRig(const MotionMeasurement& of_body, const Eigen::Isometry3d& T_body_rig);

/// Where an odometer has a body after one more motion of it, in `seconds` since the reading before:
/// covariances add up, along the axes of odom.
OdometryReading Reckon(const OdometryReading& before, const MotionMeasurement& of_body,
                       double seconds);

/// The rig's motion from each stamp to the next by recorded wheels: between two of their poses the
/// position goes straight, the rotation evenly (slerp). Nothing where these are more than 0.25 s
/// apart, or the stamp is beyond all. Where the track says no covariance, that of rolling.
/// `T_left_rig` carries the rectified left camera's coordinates to those of the camera as built.
WheelMotions MotionsBetween(const WheelTrack& track, const std::vector<std::int64_t>& stamps_ns,
                            const Eigen::Isometry3d& T_left_rig);

}  // namespace aisle
