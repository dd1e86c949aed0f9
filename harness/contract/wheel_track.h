#pragma once

#include <vector>

#include "harness/contract/estimate.h"

namespace aisle {

/// What a recorded vehicle's wheels made of its way. base_link has x ahead, y to the left, z up;
/// odom is a frame of the wheels' own, which drifts.
struct WheelTrack {
  Trajectory poses;  ///< T_odom_base; stamps rise
  /// Of the motion to each pose from the one before it, as a small motion of base_link then:
  /// translation (m), then rotation (rad). None where the recording does not say.
  std::vector<Eigen::Matrix<double, 6, 6>> covariances = {};
  /// Of the left camera as it is built, before rectification.
  Eigen::Isometry3d T_base_left = Eigen::Isometry3d::Identity();
};

/// What an odometer tells at one time, as nav_msgs/Odometry has it: translation, then rotation.
struct OdometryReading {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  /// Of the pose, along the axes of odom: m, then rad, squared.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// Of base_link, along its axes: m/s, then rad/s.
  Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 6> twist_covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// base_link at a camera that looks ahead: columns are where its right, down and ahead point.
inline Eigen::Isometry3d CameraAhead() {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_base_camera;
}

}  // namespace aisle
