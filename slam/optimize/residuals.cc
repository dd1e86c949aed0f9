#include "slam/optimize/residuals.h"

#include "slam/camera/se3.h"

namespace aisle::slam {

PoseBlock ToBlock(const Eigen::Isometry3d& T_rig_world) {
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(T_rig_world.linear()).normalized();
  const Eigen::Vector3d translation = T_rig_world.translation();
  return {rotation.x(),    rotation.y(),    rotation.z(),   rotation.w(),
          translation.x(), translation.y(), translation.z()};
}

Eigen::Isometry3d FromBlock(const double* block) {
  Eigen::Isometry3d T_rig_world = Eigen::Isometry3d::Identity();
  T_rig_world.linear() =
      Eigen::Map<const Eigen::Quaterniond>(block).normalized().toRotationMatrix();
  T_rig_world.translation() = Eigen::Map<const Eigen::Vector3d>(block + 4);
  return T_rig_world;
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Eigen::Map<const Vector6d> motion(delta);
  const Eigen::Quaterniond turn = ExpRotation(motion.tail<3>());
  const Eigen::Map<const Eigen::Quaterniond> rotation(x);
  const Eigen::Map<const Eigen::Vector3d> translation(x + 4);
  Eigen::Map<Eigen::Quaterniond>{x_plus_delta} = (turn * rotation).normalized();
  Eigen::Map<Eigen::Vector3d>(x_plus_delta + 4) = turn * translation + motion.head<3>();
  return true;
}

bool PoseManifold::PlusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> matrix(jacobian);
  matrix.setZero();
  matrix.topRows<6>().setIdentity();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Vector6d>{y_minus_x} = Difference(FromBlock(x), FromBlock(y));
  return true;
}

bool PoseManifold::MinusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> matrix(jacobian);
  matrix.setZero();
  matrix.leftCols<6>().setIdentity();
  return true;
}

bool ReprojectionResidual::Evaluate(double const* const* parameters, double* residuals,
                                    double** jacobians) const {
  const Eigen::Quaterniond rotation(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> translation(parameters[0] + 4);
  const Eigen::Map<const Eigen::Vector3d> point(parameters[1]);
  const Eigen::Matrix3d R = rotation.toRotationMatrix();
  const Eigen::Vector3d in_rig = R * point + translation;
  if (in_rig.z() < kNearestProjectable_m) return false;
  Eigen::Map<Eigen::Vector3d>{residuals} = sqrt_information_ * (uvd_ - Project(camera_, in_rig));
  if (!jacobians) return true;

  const Eigen::Matrix3d by_point_in_rig = -sqrt_information_ * ProjectionJacobian(camera_, in_rig);
  if (jacobians[0]) {
    Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>> by_pose(jacobians[0]);
    by_pose << by_point_in_rig, -by_point_in_rig * Skew(in_rig), Eigen::Vector3d::Zero();
  }
  if (jacobians[1]) {
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{jacobians[1]} = by_point_in_rig * R;
  }
  return true;
}

bool RelativePoseResidual::Evaluate(double const* const* parameters, double* residuals,
                                    double** jacobians) const {
  const Eigen::Isometry3d T_from_to = FromBlock(parameters[0]) * FromBlock(parameters[1]).inverse();
  const Vector6d difference = Difference(T_from_to_, T_from_to);
  Vector6d scale;
  scale << Eigen::Vector3d::Constant(1 / sigma_m_), Eigen::Vector3d::Constant(1 / sigma_rad_);
  Eigen::Map<Vector6d>{residuals} = scale.cwiseProduct(difference);
  if (!jacobians) return true;

  // A motion (rho, phi) applied after T_from_to changes the difference's translation by
  // rho - [t] phi and its rotation vector r by the inverse left Jacobian of SO(3), to second order.
  const Eigen::Matrix3d skew = Skew(difference.tail<3>());
  Matrix6d by_motion = Matrix6d::Zero();
  by_motion.topLeftCorner<3, 3>().setIdentity();
  by_motion.topRightCorner<3, 3>() = -Skew(difference.head<3>());
  by_motion.bottomRightCorner<3, 3>() =
      Eigen::Matrix3d::Identity() - 0.5 * skew + skew * skew / 12.0;
  using Jacobian = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
  if (jacobians[0]) {
    Eigen::Map<Jacobian> by_from(jacobians[0]);
    by_from.setZero();
    by_from.leftCols<6>() = scale.asDiagonal() * by_motion;
  }
  if (jacobians[1]) {
    // Moving `to` by a motion moves T_from_to by its inverse, seen from `from` (the adjoint).
    const Eigen::Matrix3d R = T_from_to.linear();
    Matrix6d adjoint = Matrix6d::Zero();
    adjoint.topLeftCorner<3, 3>() = -R;
    adjoint.topRightCorner<3, 3>() = -Skew(T_from_to.translation()) * R;
    adjoint.bottomRightCorner<3, 3>() = -R;
    Eigen::Map<Jacobian> by_to(jacobians[1]);
    by_to.setZero();
    by_to.leftCols<6>() = scale.asDiagonal() * by_motion * adjoint;
  }
  return true;
}

}  // namespace aisle::slam
