#include "slam/camera/measured_motion.h"

#include <Eigen/Cholesky>

namespace aisle::slam {

double Chi2Between(const MeasuredMotion& one, const MeasuredMotion& other) {
  const Vector6d off = Difference(one.T_now_before, other.T_now_before);
  const Matrix6d covariance = one.covariance + other.covariance;
  return off.dot(covariance.ldlt().solve(off));
}

Matrix6d Adjoint(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = R;
  adjoint.topRightCorner<3, 3>() = Skew(T.translation()) * R;
  adjoint.bottomRightCorner<3, 3>() = R;
  return adjoint;
}

MeasuredMotion Compose(const MeasuredMotion& first, const MeasuredMotion& then) {
  const Matrix6d carry = Adjoint(then.T_now_before);
  return {Normalized(then.T_now_before * first.T_now_before),
          carry * first.covariance * carry.transpose() + then.covariance};
}

}  // namespace aisle::slam
