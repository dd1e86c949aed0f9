#include "slam/track/inertia.h"

#include <gtest/gtest.h>

#include <random>

namespace aisle::slam {
namespace {

constexpr double kStep_s = 0.05;

/// Steps of a rig that is driven by independent accelerations, each seen with noise.
class Drive {
 public:
  explicit Drive(std::uint64_t seed) : random_(seed) {
    velocity_ << 0, 0, -1, 0, 0.1, 0;
    seen_ << 0.003, 0.003, 0.004, 0.001, 0.001, 0.001;
  }

  MeasuredMotion Next(const InertiaOptions& options) {
    for (int k = 0; k < 6; ++k) {
      const double deviation =
          k < 3 ? options.acceleration_mps2 : options.angular_acceleration_radps2;
      velocity_[k] += deviation * kStep_s * normal_(random_);
    }
    Vector6d step = velocity_ * kStep_s;
    for (int k = 0; k < 6; ++k) step[k] += seen_[k] * normal_(random_);
    return {Retract(Eigen::Isometry3d::Identity(), step), seen_.cwiseAbs2().asDiagonal()};
  }

  const Vector6d& velocity() const { return velocity_; }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Vector6d velocity_, seen_;
};

TEST(Learn, KnowsTheVelocityAsWellAsItSays) {
  const InertiaOptions options;
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Drive drive(seed);
    std::optional<Velocity> velocity;
    for (int k = 0; k < 60; ++k) {
      velocity = Learn(velocity, drive.Next(options), kStep_s, options);
      const Vector6d off = drive.velocity() - velocity->per_second;
      sum += off.dot(velocity->covariance.ldlt().solve(off)) / 6;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 1, 0.1);  // the mean of chi-square over its degrees of freedom
}

TEST(Learn, IsBetterThanTheLastStepAlone) {
  const InertiaOptions gentle{.acceleration_mps2 = 0.2, .angular_acceleration_radps2 = 0.2};
  Drive drive(1);
  std::optional<Velocity> velocity;
  double of_filter = 0, of_step = 0;
  for (int k = 0; k < 400; ++k) {
    const MeasuredMotion step = drive.Next(gentle);
    velocity = Learn(velocity, step, kStep_s, gentle);
    const Vector6d seen = Difference(Eigen::Isometry3d::Identity(), step.T_now_before) / kStep_s;
    of_filter += (drive.velocity() - velocity->per_second).squaredNorm();
    of_step += (drive.velocity() - seen).squaredNorm();
  }
  EXPECT_LT(of_filter, 0.2 * of_step);
}

TEST(Learn, AStepThatNoVehicleTakesTeachesNothing) {
  const InertiaOptions options;
  Velocity driving;
  driving.per_second << 0, 0, -1, 0, 0, 0;
  driving.covariance = 1e-4 * Matrix6d::Identity();
  const MeasuredMotion stop{Eigen::Isometry3d::Identity(), 1e-8 * Matrix6d::Identity()};
  const Velocity after = Learn(driving, stop, kStep_s, options);
  EXPECT_EQ(after.per_second, driving.per_second);
  EXPECT_GT(after.covariance.trace(), driving.covariance.trace());
}

TEST(Learn, ButOneThatLastsIsBelievedInTheEnd) {
  const InertiaOptions options;
  std::optional<Velocity> velocity = Velocity{};
  velocity->per_second << 0, 0, -1, 0, 0, 0;
  velocity->covariance = 1e-4 * Matrix6d::Identity();
  const MeasuredMotion stop{Eigen::Isometry3d::Identity(), 1e-8 * Matrix6d::Identity()};
  int steps = 0;
  while (velocity->per_second.norm() > 0.1 && steps < 100) {
    velocity = Learn(velocity, stop, kStep_s, options);
    ++steps;
  }
  EXPECT_GT(steps, 3);
  EXPECT_LT(steps, 20);  // a second
}

TEST(Carry, GoesOnAsBeforeAndKnowsLessTheLonger) {
  const InertiaOptions options;
  Velocity velocity;
  velocity.per_second << 0.2, 0, -1, 0, 0.3, 0;
  const MeasuredMotion near = Carry(velocity, 0.05, options), far = Carry(velocity, 0.5, options);
  EXPECT_TRUE(Difference(Eigen::Isometry3d::Identity(), near.T_now_before)
                  .isApprox(0.05 * velocity.per_second, 1e-9));
  EXPECT_TRUE(Difference(Eigen::Isometry3d::Identity(), far.T_now_before)
                  .isApprox(0.5 * velocity.per_second, 1e-9));
  // Half a second of one acceleration: a t^2.
  EXPECT_NEAR(std::sqrt(far.covariance(0, 0)), options.acceleration_mps2 * 0.25, 1e-9);
  EXPECT_LT(near.covariance(0, 0), far.covariance(0, 0));
}

}  // namespace
}  // namespace aisle::slam
