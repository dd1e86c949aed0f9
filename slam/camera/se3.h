#pragma once

#include <Eigen/Geometry>

namespace aisle::slam {

/// A small motion: translation (metres), then rotation vector (radians).
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The matrix of the cross product: Skew(a) * b = a x b.
Eigen::Matrix3d Skew(const Eigen::Vector3d& a);

/// Rotation vector -> unit quaternion (Rodrigues), exact through zero.
Eigen::Quaterniond ExpRotation(const Eigen::Vector3d& rotation_vector);

/// Unit quaternion -> rotation vector of length <= pi; the inverse of ExpRotation.
Eigen::Vector3d LogRotation(const Eigen::Quaterniond& rotation);

/// `pose` moved by a small motion of the frame it maps *into*: x' = Exp(phi) (pose x) + rho. To
/// first order the exponential map of SE(3), and a retraction: Retract(pose, 0) = pose.
Eigen::Isometry3d Retract(const Eigen::Isometry3d& pose, const Vector6d& motion);

/// The motion that carries `from` to `to`: Retract(from, Difference(from, to)) = to.
Vector6d Difference(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to);

/// The nearest rigid motion: products of many poses drift off SO(3) by rounding.
Eigen::Isometry3d Normalized(const Eigen::Isometry3d& pose);

}  // namespace aisle::slam
