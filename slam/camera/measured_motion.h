#pragma once

#include <Eigen/Geometry>

#include "slam/camera/se3.h"

namespace aisle::slam {

/// How the rig has moved from one time to a later one, as something else than its images says:
/// wheels, an inertial unit's integral. Its covariance is of a small motion of the later rig frame
/// (see Retract), metres and radians, translation first; it is positive definite.
struct MeasuredMotion {
  Eigen::Isometry3d T_now_before = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Identity();
};

/// First one, then the other, their errors independent.
MeasuredMotion Compose(const MeasuredMotion& first, const MeasuredMotion& then);

/// How far apart two measurements of one motion are: squared difference over its covariance, as
/// their errors are independent. Of chi-square with six degrees of freedom where both are right.
double Chi2Between(const MeasuredMotion& one, const MeasuredMotion& other);

/// How a small motion of the rig's frame before shows in its frame afterwards: Retract(A, d)
/// carried by T is Retract(T A, Adjoint(T) d), to first order.
Matrix6d Adjoint(const Eigen::Isometry3d& T);

}  // namespace aisle::slam
