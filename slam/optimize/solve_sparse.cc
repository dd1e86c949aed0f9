#include "slam/optimize/solve_sparse.h"

#include <ceres/ceres.h>

#include <deque>
#include <map>

#include "slam/optimize/residuals.h"

namespace aisle::slam {
namespace {

ceres::Solver::Options SolverOptions(const BundleOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_SCHUR;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = options.relative_tolerance;
  solver.num_threads = 1;  // two threads sum in either order
  solver.logging_type = ceres::SILENT;
  return solver;
}

}  // namespace

BundleSummary SolveSparse(BundleProblem& problem, const std::vector<bool>& active,
                          const BundleOptions& options) {
  std::vector<PoseBlock> poses;
  for (const BundleProblem::Pose& pose : problem.poses) poses.push_back(ToBlock(pose.T_rig_world));
  std::vector<Eigen::Vector3d> points = problem.points;

  // Tens of thousands of residuals live for one solution: in one place they cost less to make, and
  // the problem need not count who uses them.
  std::deque<ReprojectionResidual> residuals;
  std::map<double, ceres::HuberLoss> losses;  // by bound
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  PoseManifold manifold;
  ceres::Problem ceres_problem(ownership);
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<bool> pose_used(poses.size(), false), point_used(points.size(), false);
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    const BundleProblem::Observation& observation = problem.observations[i];
    if (!active.empty() && !active[i]) continue;
    const auto pose = static_cast<std::size_t>(observation.pose);
    const auto point = static_cast<std::size_t>(observation.point);
    const double bound = observation.chi2_bound;
    ceres::LossFunction* loss =
        options.robust ? &losses.try_emplace(bound, std::sqrt(bound)).first->second : nullptr;
    ceres_problem.AddResidualBlock(
        &residuals.emplace_back(problem.camera, observation.uvd, observation.sqrt_information),
        loss, poses[pose].data(), points[point].data());
    pose_used[pose] = point_used[point] = true;
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!pose_used[i]) continue;
    ceres_problem.SetManifold(poses[i].data(), &manifold);
    if (problem.poses[i].fixed) ceres_problem.SetParameterBlockConstant(poses[i].data());
    ordering->AddElementToGroup(poses[i].data(), 1);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (point_used[i]) ordering->AddElementToGroup(points[i].data(), 0);
  }
  if (ceres_problem.NumResidualBlocks() == 0) return {0, 0, 0, true, "nothing to adjust"};

  ceres::Solver::Options solver = SolverOptions(options);
  solver.linear_solver_ordering = ordering;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &ceres_problem, &summary);
  if (summary.IsSolutionUsable()) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (!problem.poses[i].fixed) problem.poses[i].T_rig_world = FromBlock(poses[i].data());
    }
    problem.points = std::move(points);
  }
  return {summary.initial_cost, summary.final_cost, static_cast<int>(summary.iterations.size()),
          summary.IsSolutionUsable(), summary.message};
}

}  // namespace aisle::slam
