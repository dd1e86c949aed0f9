#include "slam/optimize/solve_window.h"

#include <algorithm>
#include <cmath>

#include "slam/optimize/normal_equations.h"

namespace aisle::slam {
namespace {

/// How far the quadratic model is believed (Madsen, Nielsen and Tingleff 2004, section 3.2): a step
/// that does as predicted widens the region, one that fails narrows it, twice in a row even more.
class TrustRegion {
 public:
  double damping() const { return 1 / radius_; }

  void Succeeded(double share_of_prediction) {
    const double off = 2 * share_of_prediction - 1;
    radius_ = std::min(kWidest, radius_ / std::max(1.0 / 3, 1 - off * off * off));
    narrowing_ = 2;
  }
  void Failed() {
    radius_ /= narrowing_;
    narrowing_ *= 2;
  }
  bool vanished() const { return radius_ < kNarrowest; }

 private:
  static constexpr double kWidest = 1e16, kNarrowest = 1e-32;
  double radius_ = 1e4, narrowing_ = 2;
};

BundleProblem Moved(const BundleProblem& problem, const BundleOrder& order,
                    const BundleStep& step) {
  BundleProblem moved{problem.camera, problem.poses, problem.points, {}};
  for (std::size_t i = 0; i < order.free_poses.size(); ++i) {
    Eigen::Isometry3d& pose = moved.poses[order.free_poses[i]].T_rig_world;
    pose = Normalized(Retract(pose, step.poses[i]));
  }
  for (std::size_t i = 0; i < order.points.size(); ++i) {
    moved.points[order.points[i].point] += step.points[i];
  }
  return moved;
}

}  // namespace

BundleSummary SolveWindow(BundleProblem& problem, const std::vector<bool>& active,
                          const BundleOptions& options) {
  constexpr double kLeastShare = 1e-3;  // of the predicted decrease, for a step to count
  const BundleOrder order = OrderOf(problem, active);
  if (order.observations.empty()) return {0, 0, 0, true, "nothing to adjust"};
  const std::optional<double> initial = CostOf(problem, order, options.robust);
  if (!initial) return {0, 0, 0, false, "a point is not before its camera"};

  BundleSummary summary{*initial, *initial, 0, true, "as many iterations as allowed"};
  TrustRegion region;
  std::optional<NormalEquations> equations;  // where the problem stands
  while (summary.iterations < options.iterations) {
    ++summary.iterations;
    if (!equations) equations = Linearize(problem, order, options.robust);
    const std::optional<SolvedStep> solved = SolveDamped(*equations, region.damping());
    std::optional<double> cost;
    if (solved && solved->predicted_decrease > 0) {
      BundleProblem moved = Moved(problem, order, solved->step);
      moved.observations.swap(problem.observations);
      cost = CostOf(moved, order, options.robust);
      problem.observations.swap(moved.observations);
      if (cost && summary.final_cost - *cost > kLeastShare * solved->predicted_decrease) {
        problem.poses = std::move(moved.poses);
        problem.points = std::move(moved.points);
      } else {
        cost.reset();
      }
    }
    if (!cost) {
      region.Failed();
      if (region.vanished()) return summary.message = "no step helps", summary;
      continue;
    }
    const double decrease = summary.final_cost - *cost;
    region.Succeeded(decrease / solved->predicted_decrease);
    equations.reset();
    const double before = std::exchange(summary.final_cost, *cost);
    if (decrease <= options.relative_tolerance * before) {
      summary.message = "the cost falls no more";
      return summary;
    }
  }
  return summary;
}

}  // namespace aisle::slam
