#include "slam/optimize/refine_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "slam/optimize/huber.h"

namespace aisle::slam {
namespace {

/// Error over deviation: rows u, v, and disparity (zero where not measured). Of the right camera
/// alone u is that of its own image.
Eigen::Vector3d Whitened(const Measurement& measurement, const Eigen::Vector3d& predicted) {
  Eigen::Vector3d error = measurement.uvd - predicted;
  if (measurement.right) error.x() += predicted.z();
  return {error.x() / measurement.sigma_px, error.y() / measurement.sigma_px,
          measurement.has_depth()
              ? (error.z() - measurement.u_in_d * error.x()) / measurement.sigma_d
              : 0.0};
}

/// Sum of weighted squares around one pose, to second order.
struct Normal {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double cost = 0;
};

class PoseProblem {
 public:
  PoseProblem(const StereoCamera& camera, const std::vector<PointObservation>& observations,
              const std::optional<PosePrior>& prior)
      : camera_(camera), observations_(observations), prior_(prior) {}

  double Cost(const Eigen::Isometry3d& pose, const std::vector<bool>& active, bool robust) const {
    double cost = CostOfPrior(pose);
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      if (!active[i]) continue;
      const double chi2 = Chi2(camera_, pose, observations_[i]);
      // A point that has slipped behind the camera costs its bound: no pose gains by hiding an
      // inlier. An outlier costs more than that in sight; but none draws a pose, as Linearize
      // leaves hidden points out.
      const double bound = Chi2Bound(observations_[i].measurement);
      cost += std::isinf(chi2) ? bound : robust ? Huber(chi2, bound).cost : chi2;
    }
    return cost;
  }

  Normal Linearize(const Eigen::Isometry3d& pose, const std::vector<bool>& active,
                   bool robust) const {
    Normal normal;
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Measurement& measurement = observations_[i].measurement;
      const Eigen::Vector3d point = pose * observations_[i].point;
      if (!active[i] || point.z() < kNearestVisible_m) continue;
      const Eigen::Vector3d error = Whitened(measurement, Project(camera_, point));
      Eigen::Matrix3d by_point = -ProjectionJacobian(camera_, point);
      if (measurement.right) by_point.row(0) -= by_point.row(2);
      by_point.row(2) -= measurement.u_in_d * by_point.row(0);
      by_point.topRows<2>() /= measurement.sigma_px;
      by_point.row(2) *= measurement.has_depth() ? 1.0 / measurement.sigma_d : 0.0;
      Eigen::Matrix<double, 3, 6> jacobian;
      jacobian << by_point, -by_point * Skew(point);
      const double weight =
          robust ? Huber(error.squaredNorm(), Chi2Bound(measurement)).weight : 1.0;
      normal.H.noalias() += weight * jacobian.transpose() * jacobian;
      normal.b.noalias() -= weight * jacobian.transpose() * error;
    }
    if (prior_) {
      // Near the prior a small motion changes the difference by itself, to first order.
      normal.H += prior_->information;
      normal.b -= prior_->information * Difference(prior_->T_rig_world, pose);
    }
    normal.cost = Cost(pose, active, robust);
    return normal;
  }

 private:
  double CostOfPrior(const Eigen::Isometry3d& pose) const {
    if (!prior_) return 0;
    const Vector6d off = Difference(prior_->T_rig_world, pose);
    return off.dot(prior_->information * off);
  }

  const StereoCamera& camera_;
  const std::vector<PointObservation>& observations_;
  const std::optional<PosePrior>& prior_;
};

Eigen::Isometry3d Minimize(const PoseProblem& problem, Eigen::Isometry3d pose,
                           const std::vector<bool>& active, bool robust, int iterations) {
  double damping = 1e-4;
  for (int i = 0; i < iterations; ++i) {
    const Normal normal = problem.Linearize(pose, active, robust);
    bool improved = false;
    for (int attempt = 0; attempt < 5 && !improved; ++attempt) {
      Matrix6d damped = normal.H;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-9;
      const Vector6d step = damped.ldlt().solve(normal.b);
      const Eigen::Isometry3d moved = Retract(pose, step);
      const double cost = problem.Cost(moved, active, robust);
      improved = step.allFinite() && cost < normal.cost;
      damping = improved ? damping * 0.2 : damping * 10;
      if (!improved) continue;
      pose = moved;
      if (normal.cost - cost < 1e-7 * normal.cost) return pose;
    }
    if (!improved) return pose;
  }
  return pose;
}

}  // namespace

double Chi2(const StereoCamera& camera, const Eigen::Isometry3d& T_rig_world,
            const PointObservation& observation) {
  const Eigen::Vector3d point = T_rig_world * observation.point;
  if (point.z() < kNearestVisible_m) return std::numeric_limits<double>::infinity();
  return Whitened(observation.measurement, Project(camera, point)).squaredNorm();
}

RefinedPose RefinePose(const StereoCamera& camera, const Eigen::Isometry3d& T_rig_world,
                       const std::vector<PointObservation>& observations,
                       const RefinePoseOptions& options) {
  const PoseProblem problem(camera, observations, options.prior);
  RefinedPose refined;
  refined.T_rig_world = T_rig_world;
  refined.inlier.assign(observations.size(), true);
  const auto tell_outliers = [&] {
    refined.inliers = 0;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      refined.inlier[i] = Chi2(camera, refined.T_rig_world, observations[i]) <=
                          Chi2Bound(observations[i].measurement);
      refined.inliers += refined.inlier[i];
    }
  };
  if (options.trust_start) tell_outliers();
  for (int round = 0; round < options.rounds; ++round) {
    const bool robust = round + 1 < options.rounds;
    const Eigen::Isometry3d& start = options.start_anew ? T_rig_world : refined.T_rig_world;
    refined.T_rig_world = Minimize(problem, start, refined.inlier, robust, options.iterations);
    tell_outliers();
    if (refined.inliers < 3 && !options.prior) return refined;
  }
  const Matrix6d information = problem.Linearize(refined.T_rig_world, refined.inlier, false).H;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information, Eigen::EigenvaluesOnly);
  refined.well_posed = eigen.eigenvalues()(0) > 1e-9 * eigen.eigenvalues()(5);
  if (refined.well_posed) refined.covariance = information.inverse();
  return refined;
}

}  // namespace aisle::slam
