#include "slam/optimize/bundle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/optimize/residuals.h"
#include "slam/optimize/solve_sparse.h"
#include "slam/optimize/solve_window.h"

namespace aisle::slam {

BundleProblem::Observation MakeObservation(int pose, int point, const Measurement& measurement) {
  BundleProblem::Observation observation{pose, point, measurement.uvd, Eigen::Matrix3d::Zero(),
                                         Chi2Bound(measurement)};
  observation.sqrt_information.diagonal() << 1 / measurement.sigma_px, 1 / measurement.sigma_px,
      measurement.has_depth() ? 1 / measurement.sigma_d : 0.0;
  observation.sqrt_information(2, 0) = -measurement.u_in_d * observation.sqrt_information(2, 2);
  return observation;
}

double Chi2(const BundleProblem& problem, const BundleProblem::Observation& observation) {
  const Eigen::Vector3d point =
      problem.poses[static_cast<std::size_t>(observation.pose)].T_rig_world *
      problem.points[static_cast<std::size_t>(observation.point)];
  if (point.z() < kNearestProjectable_m) return std::numeric_limits<double>::infinity();
  return (observation.sqrt_information * (observation.uvd - Project(problem.camera, point)))
      .squaredNorm();
}

std::vector<bool> WithProjection(const BundleProblem& problem) {
  std::vector<bool> has;
  for (const BundleProblem::Observation& observation : problem.observations) {
    has.push_back(std::isfinite(Chi2(problem, observation)));
  }
  return has;
}

std::vector<bool> WithinBounds(const BundleProblem& problem) {
  std::vector<bool> within;
  for (const BundleProblem::Observation& observation : problem.observations) {
    within.push_back(Chi2(problem, observation) <= observation.chi2_bound);
  }
  return within;
}

BundleSummary Solve(BundleProblem& problem, const std::vector<bool>& active,
                    const BundleOptions& options) {
  // Measured where neighbours share points with the next 5 or 20: below it the dense matrix is the
  // sooner solved one, 1.5 to 6 times; its cost grows with the third power, its memory with the
  // second.
  constexpr std::ptrdiff_t kMostInWindow = 300;
  const auto free = [](const BundleProblem::Pose& pose) { return !pose.fixed; };
  return std::ranges::count_if(problem.poses, free) > kMostInWindow
             ? SolveSparse(problem, active, options)
             : SolveWindow(problem, active, options);
}

}  // namespace aisle::slam
