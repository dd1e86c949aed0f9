#include "slam/track/motion_model.h"

#include <gtest/gtest.h>

namespace aisle::slam {
namespace {

Eigen::Isometry3d Pose(double x, double z, double yaw) {
  Vector6d motion;
  motion << x, 0.1, z, 0, yaw, 0.02;
  return Retract(Eigen::Isometry3d::Identity(), motion);
}

TEST(MotionModel, PredictsTheFrameItWasEstimatedFrom) {
  const Eigen::Isometry3d before = Pose(0, 0, 0), after = Pose(0.05, 0.3, 0.04);
  const auto motion = EstimateMotion(before, after, 0.05);
  ASSERT_TRUE(motion);
  EXPECT_TRUE(PredictPose(before, motion, 0.05).isApprox(after, 1e-12));
}

TEST(MotionModel, GoesTwiceAsFarInTwiceTheTime) {
  const auto motion = EstimateMotion(Pose(0, 0, 0), Pose(0, 0.3, 0), 0.05);
  const Eigen::Isometry3d near = PredictPose(Pose(0, 0, 0), motion, 0.05);
  const Eigen::Isometry3d far = PredictPose(Pose(0, 0, 0), motion, 0.1);
  const Eigen::Vector3d start = Pose(0, 0, 0).translation();
  EXPECT_LT(((far.translation() - start) - 2 * (near.translation() - start)).norm(), 0.02);
}

TEST(MotionModel, ASteadyMotionForgetsByHalfInItsHalfLife) {
  const Motion before{Vector6d::Constant(1)}, latest{Vector6d::Constant(3)};
  EXPECT_TRUE(Smoothed(before, latest, 0.4, 0.4).per_second.isApprox(Vector6d::Constant(2)));
  EXPECT_TRUE(Smoothed(before, latest, 0.8, 0.4).per_second.isApprox(Vector6d::Constant(2.5)));
  EXPECT_EQ(Smoothed(std::nullopt, latest, 0.05, 0.4).per_second, latest.per_second);
}

TEST(MotionModel, StandsStillWithoutTimeOrMotion) {
  const Eigen::Isometry3d here = Pose(1, 2, 0.3);
  const auto motion = EstimateMotion(Pose(0, 0, 0), here, 0.05);
  EXPECT_EQ(PredictPose(here, std::nullopt, 0.05).matrix(), here.matrix());
  EXPECT_EQ(PredictPose(here, motion, 0).matrix(), here.matrix());
  EXPECT_EQ(PredictPose(here, motion, -1).matrix(), here.matrix());
  EXPECT_FALSE(EstimateMotion(here, here, 0));
}

}  // namespace
}  // namespace aisle::slam
