#include "slam/camera/se3.h"

#include <cmath>

namespace aisle::slam {

Eigen::Matrix3d Skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(),  //
      a.z(), 0, -a.x(),        //
      -a.y(), a.x(), 0;
  return matrix;
}

Eigen::Quaterniond ExpRotation(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  // sin(x/2)/x by its series where the quotient would lose digits.
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(angle / 2) / angle;
  Eigen::Quaterniond rotation;
  rotation.w() = std::cos(angle / 2);
  rotation.vec() = scale * rotation_vector;
  return rotation.normalized();
}

Eigen::Vector3d LogRotation(const Eigen::Quaterniond& rotation) {
  // q and -q are one rotation; the half with w >= 0 has the shorter vector.
  const double sign = rotation.w() < 0 ? -1.0 : 1.0;
  const double sine = rotation.vec().norm();
  if (sine < 1e-10) return 2.0 * sign * rotation.vec();
  return 2.0 * std::atan2(sine, sign * rotation.w()) / sine * sign * rotation.vec();
}

Eigen::Isometry3d Retract(const Eigen::Isometry3d& pose, const Vector6d& motion) {
  const Eigen::Quaterniond turn = ExpRotation(motion.tail<3>());
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() =
      (turn * Eigen::Quaterniond(pose.linear()).normalized()).normalized().toRotationMatrix();
  moved.translation() = turn * pose.translation() + motion.head<3>();
  return moved;
}

Vector6d Difference(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(to.linear()).normalized() *
                                  Eigen::Quaterniond(from.linear()).normalized().conjugate();
  Vector6d motion;
  motion.head<3>() = to.translation() - turn * from.translation();
  motion.tail<3>() = LogRotation(turn);
  return motion;
}

Eigen::Isometry3d Normalized(const Eigen::Isometry3d& pose) {
  Eigen::Isometry3d normalized = Eigen::Isometry3d::Identity();
  normalized.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  normalized.translation() = pose.translation();
  return normalized;
}

}  // namespace aisle::slam
