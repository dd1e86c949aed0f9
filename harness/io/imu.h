#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace aisle {

struct ImuSample {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< rad/s, in the rig frame
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();    ///< m/s², in the rig frame
};

inline constexpr double kGravityMps2 = 9.81;  ///< downwards along world z

/// What a perfect IMU in the rig frame measures along a path, from first to last inclusive: angular
/// velocity and f = R^T (a - g); at rest it measures +g upwards.
///
/// Samples are no instants but weighted means over the two intervals on either side, so that
/// nothing between them is lost, a step of the acceleration neither; the weights are such that
/// integrating by the trapezoidal rule (the mean of two neighbouring samples over the interval
/// between them, the force turned into the world by each one's own rotation before) gives the
/// velocities and rotations of the path to the fourth order of the interval. From an instant they
/// differ by d^2/12 times its second derivative. A sample held constant over the interval that
/// follows is, as with any IMU, half an interval late.
std::vector<ImuSample> IdealImu(const std::function<Eigen::Isometry3d(std::int64_t)>& path,
                                std::int64_t first_ns, std::int64_t last_ns, double rate_hz);

/// Velocity of the rig, m/s, world, by central differences of the fourth order over the samples'
/// interval: the state from which integrating such samples stays on the path, even one that begins
/// as the acceleration steps.
Eigen::Vector3d VelocityAt(const std::function<Eigen::Isometry3d(std::int64_t)>& path,
                           std::int64_t stamp_ns, double rate_hz);

/// EuRoC's imu0/data.csv: stamp, gyroscope, accelerometer.
std::string FormatEurocImu(const std::vector<ImuSample>& samples, std::int64_t epoch_ns);

}  // namespace aisle
