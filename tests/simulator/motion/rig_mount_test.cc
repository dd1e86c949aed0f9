#include "simulator/motion/rig_mount.h"

#include <gtest/gtest.h>

#include <numbers>

namespace aisle::sim {
namespace {

using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
const Bump kBump{.at_s = 1, .height_m = 0.02, .pitch_rad = 0.03};

RouteState SomeState() {
  RouteState state;
  state.position = {2, 3};
  state.heading_rad = 0.7;
  return state;
}

Isometry3d PoseAt(const RigMount& mount, double time_s) {
  return RigPose(SomeState(), mount, {&kBump, 1}, time_s);
}

TEST(RigMount, ABumpChangesTheAccelerationGradually) {
  const Bump bump{2, 0.02, 0.03, 4, 0.25};
  const auto height = [&](double t) { return RigPose({}, {}, {&bump, 1}, t).translation().z(); };
  const double h = 1e-3;
  const auto acceleration = [&](double t) {
    return (height(t + h) - 2 * height(t) + height(t - h)) / (h * h);
  };
  double highest = 0;
  for (double t = 1.9; t < 4; t += h) {
    EXPECT_NEAR(acceleration(t + h), acceleration(t), 1.2) << t;
    highest = std::max(highest, std::abs(height(t) - RigMount{}.height_m));
  }
  EXPECT_GT(highest, 0.6 * bump.height_m);
  EXPECT_LT(highest, bump.height_m);
}

TEST(RigMount, LooksAlongTheHeadingWithTheImageUpright) {
  RouteState state;
  state.position = {2, 3};
  state.heading_rad = pi / 2;
  const Isometry3d pose = RigPose(state, {0.8, 0.5, 0.1}, {}, 0);
  EXPECT_TRUE(pose.translation().isApprox(Vector3d(2, 3.5, 0.8), 1e-12));
  const Vector3d forward = pose.linear().col(2), down = pose.linear().col(1);
  EXPECT_TRUE(forward.isApprox(Vector3d(0, std::cos(0.1), -std::sin(0.1)), 1e-12));
  EXPECT_LT(down.z(), -0.99);
  EXPECT_NEAR(pose.linear().determinant(), 1, 1e-12);
}

/// Height and pitch swing together, and positive looks down.
TEST(RigMount, ABumpLowersTheViewAsItLiftsTheCamera) {
  const RigMount mount{.height_m = 0.9, .pitch_rad = 0.1};
  double highest_m = 0;
  for (double t = 0.9; t < 3; t += 0.01) {
    const Isometry3d pose = PoseAt(mount, t);
    const double lift_m = pose.translation().z() - mount.height_m;
    const double down_rad = std::asin(-pose.linear()(2, 2)) - mount.pitch_rad;
    EXPECT_NEAR(down_rad, lift_m / kBump.height_m * kBump.pitch_rad, 1e-9) << t;
    highest_m = std::max(highest_m, lift_m);
  }
  EXPECT_GT(highest_m, 0.01) << "it goes up first";
}

/// A camera that looks aside rolls where one that looks ahead nods.
TEST(RigMount, ABumpTurnsTheVehicleWhereverTheCameraLooks) {
  const auto turn = [](const RigMount& mount, double t) {
    return Matrix3d(PoseAt(mount, t).linear() * PoseAt(mount, 0).linear().transpose());
  };
  double largest_rad = 0;
  for (double t = 0.9; t < 3; t += 0.01) {
    const Matrix3d ahead = turn({}, t);
    for (const RigMount& mount : {RigMount{.pitch_rad = 0.2}, RigMount{.yaw_rad = 1e-9},
                                  RigMount{.yaw_rad = pi / 2}, RigMount{.roll_rad = 0.4},
                                  RigMount{.pitch_rad = -0.1, .yaw_rad = 2.5, .roll_rad = -0.2}}) {
      EXPECT_LT((turn(mount, t) - ahead).norm(), 1e-8) << t << ", yaw " << mount.yaw_rad;
    }
    largest_rad = std::max(largest_rad, Eigen::AngleAxisd(ahead).angle());
  }
  EXPECT_GT(largest_rad, 0.015);
}

}  // namespace
}  // namespace aisle::sim
