#pragma once

#include <Eigen/Core>
#include <string>

namespace aisle {

/// What a covariance of a ROS message says. All zeros say that it is unknown, and -1 in its first
/// place that there is none (sensor_msgs/Imu has it in writing); so do directions of no variance,
/// which nothing can be weighed by.
bool SaysCovariance(const Eigen::Matrix<double, 6, 6>& matrix);

/// Why no motion can have that covariance, with the entry; empty: one can, or it says nothing. A
/// variance of 1e12, with which simulators write that a direction was not measured, is a good one.
std::string CovarianceFault(const Eigen::Matrix<double, 6, 6>& matrix);

}  // namespace aisle
