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

/// What a perfect IMU in the rig frame measures along a path, from first to last inclusive:
/// ω = log(R(t)ᵀ R(t+h)) / h and f = Rᵀ (a - g), by central differences over h = 1 ms. At rest it
/// measures +g upwards.
std::vector<ImuSample> IdealImu(const std::function<Eigen::Isometry3d(std::int64_t)>& path,
                                std::int64_t first_ns, std::int64_t last_ns, double rate_hz);

/// EuRoC's imu0/data.csv: stamp, gyroscope, accelerometer.
std::string FormatEurocImu(const std::vector<ImuSample>& samples, std::int64_t epoch_ns);

}  // namespace aisle
