#include "slam/camera/se3.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

std::vector<Vector6d> AwkwardMotions() {
  std::vector<Vector6d> motions(8, Vector6d::Zero());
  motions[1] << 1, -2, 3, 0.1, 0.2, -0.3;
  motions[2] << 0, 0, 0, 1e-9, 0, -1e-9;
  motions[3] << 5, 0, 0, 3.1, 0, 0;
  motions[4] << 0.01, 0.02, 0.03, 0, 1e-5, 0;
  motions[5] << -7, 8, 9, -1.2, 1.4, 0.7;
  motions[6] << 0, 0, 0, -3e-11, 2e-11, 0;
  motions[7] << 1e-12, 0, 0, 0, 0, 1e-200;
  return motions;
}

Eigen::Isometry3d SomePose() {
  Vector6d motion;
  motion << 0.3, -4, 2, 0.5, -1.1, 0.2;
  return Retract(Eigen::Isometry3d::Identity(), motion);
}

TEST(Se3, LogarithmUndoesExponential) {
  for (const Vector6d& motion : AwkwardMotions()) {
    const Eigen::Vector3d turn = motion.tail<3>();
    EXPECT_LE((LogRotation(ExpRotation(turn)) - turn).norm(), 1e-12 * turn.norm())
        << turn.transpose();
  }
}

/// Half a turn has two logarithms, one either way round its axis; either will do.
TEST(Se3, HalfATurnIsPiAboutItsAxis) {
  const std::vector<Eigen::Vector3d> axes = {
      Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(),
      Eigen::Vector3d(1, 2, -2) / 3, -Eigen::Vector3d::UnitX()};
  for (const Eigen::Vector3d& axis : axes) {
    Eigen::Quaterniond half;
    half.w() = 0;
    half.vec() = axis;
    const Eigen::Quaterniond as_matrix(
        Eigen::Matrix3d(2 * axis * axis.transpose() - Eigen::Matrix3d::Identity()));
    for (const Eigen::Quaterniond& turn : {half, as_matrix, ExpRotation(M_PI * axis)}) {
      const Eigen::Vector3d vector = LogRotation(turn);
      EXPECT_NEAR(vector.norm(), M_PI, 1e-12) << axis.transpose();
      EXPECT_NEAR(std::abs(vector.dot(axis)), M_PI, 1e-12) << axis.transpose();
      EXPECT_NEAR(std::abs(ExpRotation(vector).dot(half)), 1, 1e-12) << axis.transpose();
    }
    Vector6d motion;
    motion << 1, -2, 3, M_PI * axis;
    const Eigen::Isometry3d turned = Retract(SomePose(), motion);
    EXPECT_TRUE(Retract(SomePose(), Difference(SomePose(), turned)).isApprox(turned, 1e-12));
  }
}

TEST(Se3, QuaternionAndItsNegativeHaveOneLogarithm) {
  const Eigen::Quaterniond q = ExpRotation({0.3, -0.2, 0.9});
  const Eigen::Quaterniond minus(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_LT((LogRotation(q) - LogRotation(minus)).norm(), 1e-14);
}

TEST(Se3, DifferenceIsTheMotionThatWasRetracted) {
  for (const Vector6d& motion : AwkwardMotions()) {
    EXPECT_LT((Difference(SomePose(), Retract(SomePose(), motion)) - motion).norm(), 1e-12);
  }
}

TEST(Se3, RetractingByNothingChangesNothing) {
  EXPECT_TRUE(Retract(SomePose(), Vector6d::Zero()).isApprox(SomePose(), 1e-15));
}

TEST(Se3, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a(1, -2, 3), b(0.5, 4, -1);
  EXPECT_LT((Skew(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(Se3, RetractionTurnsAndThenShiftsWhatThePoseMaps) {
  Vector6d motion;
  motion << 1, 2, 3, 0, 0, M_PI / 2;
  const Eigen::Vector3d moved =
      Retract(Eigen::Isometry3d::Identity(), motion) * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((moved - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace aisle::slam
