#include "slam/camera/measured_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <random>

namespace aisle::slam {
namespace {

Vector6d Drawn(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector6d drawn;
  for (double& value : drawn) value = normal(random);
  return drawn;
}

Eigen::Isometry3d SomePose(std::mt19937_64& random) {
  return Retract(Eigen::Isometry3d::Identity(), 0.5 * Drawn(random));
}

TEST(MeasuredMotion, AdjointCarriesASmallMotion) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d T = SomePose(random), A = SomePose(random);
    const Vector6d small = 1e-5 * Drawn(random);
    const Eigen::Isometry3d carried = Retract(T * A, Adjoint(T) * small);
    EXPECT_LT(Difference(carried, T * Retract(A, small)).norm(), 1e-9);
  }
}

/// What many disturbed motions, one after the other, scatter by.
TEST(MeasuredMotion, ComposedCovarianceIsThatOfManyDraws) {
  std::mt19937_64 random(2);
  std::vector<MeasuredMotion> steps;
  for (int i = 0; i < 3; ++i) {
    const Matrix6d root = 1e-3 * (Matrix6d::Identity() + 0.3 * Matrix6d::Random());
    steps.push_back({SomePose(random), root * root.transpose()});
  }
  MeasuredMotion whole{Eigen::Isometry3d::Identity(), Matrix6d::Zero()};
  for (const MeasuredMotion& step : steps) whole = Compose(whole, step);
  constexpr int kDraws = 20000;
  Matrix6d scatter = Matrix6d::Zero();
  for (int n = 0; n < kDraws; ++n) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (const MeasuredMotion& step : steps) {
      const Vector6d error = step.covariance.llt().matrixL() * Drawn(random);
      T = Retract(step.T_now_before, error) * T;
    }
    const Vector6d off = Difference(whole.T_now_before, T);
    scatter += off * off.transpose() / kDraws;
  }
  EXPECT_LT((scatter - whole.covariance).norm(), 0.05 * whole.covariance.norm());
}

/// As many degrees of freedom as a motion has, in the mean.
TEST(MeasuredMotion, TwoMeasurementsOfOneMotionDifferByChiSquare) {
  std::mt19937_64 random(3);
  const Eigen::Isometry3d truth = SomePose(random);
  constexpr int kDraws = 20000;
  double sum = 0;
  for (int n = 0; n < kDraws; ++n) {
    std::array<MeasuredMotion, 2> measured;
    for (MeasuredMotion& one : measured) {
      const Matrix6d root = 1e-3 * (Matrix6d::Identity() + 0.3 * Matrix6d::Random());
      one = {Retract(truth, root * Drawn(random)), root * root.transpose()};
    }
    sum += Chi2Between(measured[0], measured[1]);
  }
  EXPECT_NEAR(sum / kDraws, 6, 0.15);
}

}  // namespace
}  // namespace aisle::slam
