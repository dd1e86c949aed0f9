#include "slam/optimize/normal_equations.h"

#include <algorithm>

#include "slam/optimize/huber.h"
#include "slam/optimize/residuals.h"

namespace aisle::slam {
namespace {

/// One observation: its whitened error, and the point where its camera sees it.
struct Sight {
  Eigen::Vector3d in_rig, error;
};

Sight SightOf(const BundleProblem& problem, const BundleProblem::Observation& observation) {
  Sight sight;
  sight.in_rig = problem.poses[static_cast<std::size_t>(observation.pose)].T_rig_world *
                 problem.points[static_cast<std::size_t>(observation.point)];
  if (sight.in_rig.z() >= kNearestProjectable_m) {
    sight.error =
        observation.sqrt_information * (observation.uvd - Project(problem.camera, sight.in_rig));
  }
  return sight;
}

RobustCost CostOf(const BundleProblem::Observation& observation, double chi2, bool robust) {
  return robust ? Huber(chi2, observation.chi2_bound) : RobustCost{chi2, 1.0};
}

}  // namespace

BundleOrder OrderOf(const BundleProblem& problem, const std::vector<bool>& active) {
  const auto& all = problem.observations;
  BundleOrder order;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (active.empty() || active[i]) order.observations.push_back(i);
  }
  std::ranges::stable_sort(order.observations, [&](std::size_t a, std::size_t b) {
    return std::pair(all[a].point, all[a].pose) < std::pair(all[b].point, all[b].pose);
  });

  std::vector<bool> used(problem.poses.size(), false);
  for (std::size_t k = 0; k < order.observations.size(); ++k) {
    const BundleProblem::Observation& observation = all[order.observations[k]];
    used[static_cast<std::size_t>(observation.pose)] = true;
    const auto point = static_cast<std::size_t>(observation.point);
    if (order.points.empty() || order.points.back().point != point) {
      order.points.push_back({point, k, k});
    }
    order.points.back().end = k + 1;
  }
  order.free_index.assign(problem.poses.size(), -1);
  for (std::size_t i = 0; i < problem.poses.size(); ++i) {
    if (!used[i] || problem.poses[i].fixed) continue;
    order.free_index[i] = static_cast<int>(order.free_poses.size());
    order.free_poses.push_back(i);
  }
  return order;
}

std::optional<double> CostOf(const BundleProblem& problem, const BundleOrder& order, bool robust) {
  double cost = 0;
  for (const std::size_t i : order.observations) {
    const BundleProblem::Observation& observation = problem.observations[i];
    const Sight sight = SightOf(problem, observation);
    if (!(sight.in_rig.z() >= kNearestProjectable_m)) return std::nullopt;
    cost += CostOf(observation, sight.error.squaredNorm(), robust).cost;
  }
  return cost / 2;
}

NormalEquations Linearize(const BundleProblem& problem, const BundleOrder& order, bool robust) {
  NormalEquations equations;
  equations.pose_H.assign(order.free_poses.size(), Matrix6d::Zero());
  equations.pose_g.assign(order.free_poses.size(), Vector6d::Zero());
  equations.points.reserve(order.points.size());
  equations.couplings.reserve(order.observations.size());
  std::vector<Eigen::Matrix3d> rotations;
  for (const BundleProblem::Pose& pose : problem.poses) {
    rotations.push_back(pose.T_rig_world.linear());
  }

  for (const BundleOrder::Seen& seen : order.points) {
    NormalEquations::Point& point = equations.points.emplace_back();
    point.begin = equations.couplings.size();
    for (std::size_t k = seen.begin; k < seen.end; ++k) {
      const BundleProblem::Observation& observation = problem.observations[order.observations[k]];
      const Sight sight = SightOf(problem, observation);
      const double weight = CostOf(observation, sight.error.squaredNorm(), robust).weight;
      // The error's derivative by the point as the rig sees it; it moves by rho + phi x point.
      const Eigen::Matrix3d by_point =
          -observation.sqrt_information * ProjectionJacobian(problem.camera, sight.in_rig);
      const Eigen::Matrix3d M = weight * by_point.transpose() * by_point;
      const Eigen::Vector3d b = weight * by_point.transpose() * sight.error;
      const Eigen::Matrix3d& R = rotations[static_cast<std::size_t>(observation.pose)];
      const Eigen::Matrix3d MR = M * R;
      point.H.noalias() += R.transpose() * MR;
      point.g.noalias() += R.transpose() * b;
      const int pose = order.free_index[static_cast<std::size_t>(observation.pose)];
      if (pose < 0) continue;

      const Eigen::Matrix3d S = Skew(sight.in_rig), SM = S * M;
      Matrix6d& H = equations.pose_H[static_cast<std::size_t>(pose)];
      H.topLeftCorner<3, 3>() += M;
      H.bottomLeftCorner<3, 3>() += SM;
      H.bottomRightCorner<3, 3>().noalias() -= SM * S;
      Vector6d& g = equations.pose_g[static_cast<std::size_t>(pose)];
      g.head<3>() += b;
      g.tail<3>().noalias() += S * b;
      NormalEquations::Coupling& coupling = equations.couplings.emplace_back();
      coupling.pose = pose;
      coupling.H.topRows<3>() = MR;
      coupling.H.bottomRows<3>().noalias() = SM * R;
    }
    point.end = equations.couplings.size();
  }
  for (Matrix6d& H : equations.pose_H) {
    H.topRightCorner<3, 3>() = H.bottomLeftCorner<3, 3>().transpose();
  }
  return equations;
}

}  // namespace aisle::slam
