#include "slam/optimize/pose_graph.h"

#include <gtest/gtest.h>

#include "slam/camera/se3.h"
#include "slam/optimize/residuals.h"

namespace aisle::slam {
namespace {

Eigen::Isometry3d Pose(double x, double y, double z, double a, double b, double c) {
  Vector6d motion;
  motion << x, y, z, a, b, c;
  return Retract(Eigen::Isometry3d::Identity(), motion);
}

TEST(RelativePoseResidual, DerivativesAgreeWithDifferences) {
  const Eigen::Isometry3d from = Pose(1, 2, -0.5, 0.4, -0.2, 0.3);
  const Eigen::Isometry3d to = Pose(-0.3, 1, 2, -0.1, 0.5, 0.9);
  const Eigen::Isometry3d measured =
      Retract(from * to.inverse(), 0.02 * Vector6d::LinSpaced(-1, 1));
  const RelativePoseResidual residual(measured, 0.1, 0.02);
  const PoseManifold manifold;
  PoseBlock blocks[2] = {ToBlock(from), ToBlock(to)};
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> analytic[2];
  const double* parameters[] = {blocks[0].data(), blocks[1].data()};
  double* jacobians[] = {analytic[0].data(), analytic[1].data()};
  Vector6d value;
  ASSERT_TRUE(residual.Evaluate(parameters, value.data(), jacobians));
  constexpr double kStep = 1e-6;
  for (int block = 0; block < 2; ++block) {
    for (int i = 0; i < 6; ++i) {
      Vector6d sides[2];
      for (const int sign : {0, 1}) {
        const Vector6d motion = (sign ? kStep : -kStep) * Vector6d::Unit(i);
        PoseBlock moved;
        manifold.Plus(blocks[block].data(), motion.data(), moved.data());
        const double* at[] = {block == 0 ? moved.data() : blocks[0].data(),
                              block == 1 ? moved.data() : blocks[1].data()};
        ASSERT_TRUE(residual.Evaluate(at, sides[sign].data(), nullptr));
      }
      const Vector6d numeric = (sides[1] - sides[0]) / (2 * kStep);
      EXPECT_LT((numeric - analytic[block].col(i)).norm(), 1e-4 * analytic[block].norm())
          << "block " << block << " motion " << i;
    }
  }
}

/// A ring of poses whose odometry is slightly wrong, closed by one exact edge.
TEST(SolvePoseGraph, ClosesARing) {
  constexpr int kPoses = 40;
  std::vector<Eigen::Isometry3d> truth;
  for (int i = 0; i < kPoses; ++i) {
    const double angle = 2 * M_PI * i / kPoses;
    truth.push_back(Pose(0, 0, 0, 0, angle, 0) * Pose(0, 0, 5, 0, 0, 0).inverse());
  }
  PoseGraph graph;
  graph.poses.push_back({truth[0], true});
  for (int i = 1; i < kPoses; ++i) {
    const auto k = static_cast<std::size_t>(i);
    Vector6d drift;
    drift << 0.01, 0, -0.005, 0, 0.003, 0;
    // From the older pose to the newer one, with drift.
    const Eigen::Isometry3d T_from_to = Retract(truth[k - 1] * truth[k].inverse(), drift);
    graph.edges.push_back({i - 1, i, T_from_to, 0.02, 0.005});
    graph.poses.push_back({T_from_to.inverse() * graph.poses[k - 1].T_rig_world, false});
  }
  const auto end_error = [&] {
    return Difference(graph.poses.back().T_rig_world, truth.back()).norm();
  };
  const double before = end_error();
  graph.edges.push_back({0, kPoses - 1, truth[0] * truth.back().inverse(), 0.002, 0.0005, true});
  EXPECT_TRUE(Solve(graph, 50).usable);
  EXPECT_GT(before, 0.1);
  EXPECT_LT(end_error(), 0.1 * before);
  EXPECT_EQ(graph.poses[0].T_rig_world.matrix(), truth[0].matrix());
}

TEST(SolvePoseGraph, LeavesAConsistentGraphAlone) {
  PoseGraph graph;
  for (int i = 0; i < 4; ++i) graph.poses.push_back({Pose(i, 0, 0.1 * i, 0, 0.1 * i, 0), i == 0});
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    graph.edges.push_back(
        {i, i + 1, graph.poses[k].T_rig_world * graph.poses[k + 1].T_rig_world.inverse()});
  }
  const PoseGraph before = graph;
  EXPECT_LT(Solve(graph, 10).final_cost, 1e-20);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(graph.poses[i].T_rig_world.isApprox(before.poses[i].T_rig_world, 1e-9));
  }
}

}  // namespace
}  // namespace aisle::slam
