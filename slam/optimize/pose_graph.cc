#include "slam/optimize/pose_graph.h"

#include <ceres/ceres.h>

#include "slam/optimize/residuals.h"

namespace aisle::slam {

BundleSummary Solve(PoseGraph& graph, int iterations) {
  std::vector<PoseBlock> poses;
  for (const BundleProblem::Pose& pose : graph.poses) poses.push_back(ToBlock(pose.T_rig_world));
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  PoseManifold manifold;
  ceres::Problem problem(ownership);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    problem.AddParameterBlock(poses[i].data(), 7, &manifold);
    if (graph.poses[i].fixed) problem.SetParameterBlockConstant(poses[i].data());
  }
  for (const PoseGraph::Edge& edge : graph.edges) {
    // Beyond three deviations a loop's say grows no more than linearly.
    ceres::LossFunction* loss = edge.may_be_wrong ? new ceres::HuberLoss(3.0) : nullptr;
    problem.AddResidualBlock(new RelativePoseResidual(edge.T_from_to, edge.sigma_m, edge.sigma_rad),
                             loss, poses[static_cast<std::size_t>(edge.from)].data(),
                             poses[static_cast<std::size_t>(edge.to)].data());
  }
  if (graph.edges.empty()) return {0, 0, 0, true, "nothing to adjust"};

  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = iterations;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (summary.IsSolutionUsable()) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!graph.poses[i].fixed) graph.poses[i].T_rig_world = FromBlock(poses[i].data());
    }
  }
  return {summary.initial_cost, summary.final_cost, static_cast<int>(summary.iterations.size()),
          summary.IsSolutionUsable(), summary.message};
}

}  // namespace aisle::slam
