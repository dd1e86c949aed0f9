#include "slam/optimize/bundle.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "slam/camera/se3.h"
#include "slam/optimize/residuals.h"
#include "tests/support/test_data.h"

namespace aisle::slam {
namespace {

Eigen::Isometry3d SomePose() {
  Vector6d motion;
  motion << 0.2, -0.1, 0.4, 0.3, -0.2, 0.1;
  return Retract(Eigen::Isometry3d::Identity(), motion);
}

TEST(ReprojectionResidual, DerivativesAgreeWithDifferences) {
  const StereoCamera camera;
  Eigen::Matrix3d root;
  root << 2, 0.1, 0, 0, 1.5, 0, 3, 0, -3;
  const ReprojectionResidual residual(camera, {300, 200, 20}, root);
  const PoseManifold manifold;
  PoseBlock pose = ToBlock(SomePose());
  Eigen::Vector3d point = SomePose().inverse() * Eigen::Vector3d(0.5, -0.4, 3);

  const auto evaluate = [&](const PoseBlock& at_pose, const Eigen::Vector3d& at_point) {
    const double* parameters[] = {at_pose.data(), at_point.data()};
    Eigen::Vector3d value;
    EXPECT_TRUE(residual.Evaluate(parameters, value.data(), nullptr));
    return value;
  };
  Eigen::Matrix<double, 3, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> by_point;
  double* jacobians[] = {by_pose.data(), by_point.data()};
  const double* parameters[] = {pose.data(), point.data()};
  Eigen::Vector3d value;
  ASSERT_TRUE(residual.Evaluate(parameters, value.data(), jacobians));
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
  manifold.PlusJacobian(pose.data(), plus.data());
  const Eigen::Matrix<double, 3, 6> by_motion = by_pose * plus;

  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    PoseBlock ahead, behind;
    const Vector6d motion = kStep * Vector6d::Unit(i), back = -motion;
    manifold.Plus(pose.data(), motion.data(), ahead.data());
    manifold.Plus(pose.data(), back.data(), behind.data());
    const Eigen::Vector3d numeric =
        (evaluate(ahead, point) - evaluate(behind, point)) / (2 * kStep);
    EXPECT_LT((numeric - by_motion.col(i)).norm(), 1e-6 * by_motion.norm()) << "motion " << i;
  }
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d shift = kStep * Eigen::Vector3d::Unit(i);
    const Eigen::Vector3d numeric =
        (evaluate(pose, point + shift) - evaluate(pose, point - shift)) / (2 * kStep);
    EXPECT_LT((numeric - by_point.col(i)).norm(), 1e-6 * by_point.norm()) << "point " << i;
  }
}

TEST(PoseManifold, PlusIsRetractAndMinusUndoesIt) {
  const PoseManifold manifold;
  const PoseBlock pose = ToBlock(SomePose());
  Vector6d motion, difference;
  motion << 0.5, 0.2, -1, 0.4, 0.1, -0.9;
  PoseBlock moved;
  manifold.Plus(pose.data(), motion.data(), moved.data());
  EXPECT_TRUE(FromBlock(moved.data()).isApprox(Retract(SomePose(), motion), 1e-12));
  manifold.Minus(moved.data(), pose.data(), difference.data());
  EXPECT_LT((difference - motion).norm(), 1e-12);
}

/// A row of rigs along a wall of points, exact, then disturbed.
BundleProblem MakeProblem(bool disturbed) {
  BundleProblem problem;
  for (int i = 0; i < 5; ++i) {
    Vector6d motion;
    motion << 0.4 * i, 0.02 * i, 0.05 * i, 0.01 * i, -0.02 * i, 0;
    problem.poses.push_back({Retract(Eigen::Isometry3d::Identity(), -motion), i == 0});
  }
  for (int i = 0; i < 60; ++i) {
    problem.points.emplace_back(-2 + 0.13 * i, -1 + 0.4 * (i % 6), 4 + 0.3 * (i % 7));
  }
  for (int p = 0; p < 5; ++p) {
    for (int i = 0; i < 60; ++i) {
      const auto& pose = problem.poses[static_cast<std::size_t>(p)].T_rig_world;
      Measurement measurement;
      measurement.uvd = Project(problem.camera, pose * problem.points[static_cast<std::size_t>(i)]);
      measurement.sigma_d = i % 3 ? 0.5 : 0;
      problem.observations.push_back(MakeObservation(p, i, measurement));
    }
  }
  if (!disturbed) return problem;
  for (std::size_t p = 1; p < 5; ++p) {
    Vector6d motion;
    motion << 0.03, -0.02, 0.02, 0.004, 0.006, -0.003;
    problem.poses[p].T_rig_world = Retract(problem.poses[p].T_rig_world, motion);
  }
  for (std::size_t i = 0; i < 60; ++i) {
    problem.points[i] += 0.05 * Eigen::Vector3d(std::sin(3.0 * static_cast<double>(i)), 0.5,
                                                std::cos(5.0 * static_cast<double>(i)));
  }
  return problem;
}

TEST(SolveBundle, RecoversTheTruth) {
  const BundleProblem truth = MakeProblem(false);
  BundleProblem problem = MakeProblem(true);
  const BundleSummary summary = Solve(problem, {}, {50, false, 1e-12});
  EXPECT_TRUE(summary.usable);
  EXPECT_LT(summary.final_cost, 1e-8);
  for (std::size_t p = 0; p < truth.poses.size(); ++p) {
    EXPECT_LT(Difference(truth.poses[p].T_rig_world, problem.poses[p].T_rig_world).norm(), 1e-5);
  }
}

TEST(SolveBundle, LeavesFixedPosesAndGivesTheSameBitsAgain) {
  BundleProblem a = MakeProblem(true), b = MakeProblem(true);
  Solve(a, {}, {});
  Solve(b, {}, {});
  EXPECT_EQ(a.poses[0].T_rig_world.matrix(), Eigen::Matrix4d::Identity());
  for (std::size_t p = 0; p < a.poses.size(); ++p) {
    EXPECT_EQ(a.poses[p].T_rig_world.matrix(), b.poses[p].T_rig_world.matrix());
  }
}

TEST(SolveBundle, WithNothingToDoDoesNothing) {
  BundleProblem problem = MakeProblem(true);
  const BundleProblem before = problem;
  const BundleSummary summary =
      Solve(problem, std::vector<bool>(problem.observations.size(), false), {});
  EXPECT_TRUE(summary.usable);
  EXPECT_EQ(problem.points, before.points);
}

/// A problem from KITTI images whose optimum was found independently: unit weights over
/// (u_left, u_right, v), first pose fixed, points from their first observation.
TEST(SolveBundle, ReachesTheKnownOptimumOfTheKittiProblem) {
  const std::filesystem::path folder = TestData("stereo-ba");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data at " << folder;
  BundleProblem problem;
  double skew = 0;
  std::ifstream(folder / "VO_calibration.txt") >> problem.camera.fx >> problem.camera.fy >> skew >>
      problem.camera.cx >> problem.camera.cy >> problem.camera.baseline_m;
  std::ifstream poses(folder / "VO_camera_poses_large.txt");
  for (int id = 0; poses >> id;) {
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix;
    for (int i = 0; i < 16; ++i) poses >> matrix.data()[i];
    Eigen::Isometry3d T_world_rig(matrix);
    problem.poses.push_back({Normalized(T_world_rig).inverse(), problem.poses.empty()});
  }
  std::ifstream factors(folder / "VO_stereo_factors_large.txt");
  std::map<int, int> point_of;
  int pose = 0, point = 0;
  double left = 0, right = 0, v = 0;
  Eigen::Vector3d in_rig;
  while (factors >> pose >> point >> left >> right >> v >> in_rig.x() >> in_rig.y() >> in_rig.z()) {
    const auto [place, is_new] = point_of.emplace(point, static_cast<int>(problem.points.size()));
    const auto& T_rig_world = problem.poses[static_cast<std::size_t>(pose - 1)].T_rig_world;
    if (is_new) problem.points.push_back(T_rig_world.inverse() * in_rig);
    BundleProblem::Observation observation{pose - 1, place->second, {left, v, left - right}, {}, 0};
    observation.sqrt_information << 1, 0, 0, 1, 0, -1, 0, 1, 0;  // u_left, u_right, v
    problem.observations.push_back(observation);
  }
  ASSERT_EQ(problem.poses.size(), 26u);
  ASSERT_EQ(problem.points.size(), 2634u);
  ASSERT_EQ(problem.observations.size(), 8189u);

  const BundleSummary summary = Solve(problem, {}, {100, false, 1e-12});
  EXPECT_NEAR(summary.initial_cost, 14538.674, 14538.674 * 1e-4);
  EXPECT_NEAR(summary.final_cost, 1577.02549, 1577.02549 * 1e-6);
}

}  // namespace
}  // namespace aisle::slam
