#include "harness/score/align.h"

#include <Eigen/SVD>
#include <stdexcept>

namespace aisle {
namespace {

struct Moments {
  Eigen::Vector3d mean_truth = Eigen::Vector3d::Zero(), mean_estimate = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< truth × estimate
  double variance_estimate = 0;
};

Moments MomentsOf(const Trajectory& truth, const Trajectory& estimate,
                  std::span<const PosePair> pairs) {
  Moments moments;
  const auto n = static_cast<double>(pairs.size());
  for (const PosePair& pair : pairs) {
    moments.mean_truth += truth[pair.truth].T_world_rig.translation();
    moments.mean_estimate += estimate[pair.estimate].T_world_rig.translation();
  }
  moments.mean_truth /= n;
  moments.mean_estimate /= n;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d x =
        estimate[pair.estimate].T_world_rig.translation() - moments.mean_estimate;
    const Eigen::Vector3d y = truth[pair.truth].T_world_rig.translation() - moments.mean_truth;
    moments.covariance += y * x.transpose();
    moments.variance_estimate += x.squaredNorm();
  }
  moments.covariance /= n;
  moments.variance_estimate /= n;
  return moments;
}

Alignment AlignPositions(const Trajectory& truth, const Trajectory& estimate,
                         std::span<const PosePair> pairs, bool with_scale) {
  const Moments moments = MomentsOf(truth, estimate, pairs);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments.covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign.z() = -1;

  Alignment result;
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  // Two independent directions fix a rotation; relative to the largest, so that units do not
  // matter.
  constexpr double kRankTolerance = 1e-9;
  const Eigen::Vector3d spread = svd.singularValues();
  result.rotation_determined = spread[1] > kRankTolerance * spread[0];
  if (with_scale && moments.variance_estimate > 0) {
    result.scale = spread.dot(sign) / moments.variance_estimate;
  }
  result.T_truth_estimate.linear() = rotation;
  result.T_truth_estimate.translation() =
      moments.mean_truth - result.scale * rotation * moments.mean_estimate;
  return result;
}

/// The turn about z that lays the estimate best onto truth: of all such rotations it has the
/// greatest trace with the covariance.
Alignment AlignPositionAndYaw(const Trajectory& truth, const Trajectory& estimate,
                              std::span<const PosePair> pairs) {
  const Moments moments = MomentsOf(truth, estimate, pairs);
  const double along = moments.covariance(0, 0) + moments.covariance(1, 1);
  const double across = moments.covariance(1, 0) - moments.covariance(0, 1);
  Alignment result;
  result.rotation_determined = along != 0 || across != 0;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(std::atan2(across, along), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  result.T_truth_estimate.linear() = rotation;
  result.T_truth_estimate.translation() = moments.mean_truth - rotation * moments.mean_estimate;
  return result;
}

Alignment AlignBy(AlignmentMethod method, const Trajectory& truth, const Trajectory& estimate,
                  std::span<const PosePair> pairs) {
  switch (method) {
    case AlignmentMethod::kNone:
      return {};
    case AlignmentMethod::kOrigin:
      return {.T_truth_estimate = truth[pairs.front().truth].T_world_rig *
                                  estimate[pairs.front().estimate].T_world_rig.inverse()};
    case AlignmentMethod::kPosYaw:
      return AlignPositionAndYaw(truth, estimate, pairs);
    case AlignmentMethod::kSe3:
      return AlignPositions(truth, estimate, pairs, false);
    case AlignmentMethod::kSim3:
      break;
  }
  return AlignPositions(truth, estimate, pairs, true);
}

}  // namespace

std::string Name(AlignmentMethod method) {
  switch (method) {
    case AlignmentMethod::kNone:
      return "none";
    case AlignmentMethod::kOrigin:
      return "origin";
    case AlignmentMethod::kPosYaw:
      return "posyaw";
    case AlignmentMethod::kSim3:
      return "sim3";
    case AlignmentMethod::kSe3:
      break;
  }
  return "se3";
}

AlignmentMethod AlignmentFromName(const std::string& name) {
  for (const auto method :
       {AlignmentMethod::kNone, AlignmentMethod::kOrigin, AlignmentMethod::kPosYaw,
        AlignmentMethod::kSe3, AlignmentMethod::kSim3}) {
    if (Name(method) == name) return method;
  }
  throw std::invalid_argument("alignment '" + name +
                              "': expected none, origin, posyaw, se3 or sim3");
}

std::size_t FewestPairs(AlignmentMethod method) {
  switch (method) {
    case AlignmentMethod::kNone:
      return 1;
    case AlignmentMethod::kOrigin:
    case AlignmentMethod::kPosYaw:
      return 2;
    case AlignmentMethod::kSe3:
    case AlignmentMethod::kSim3:
      break;
  }
  return 3;
}

Alignment Align(const Trajectory& truth, const Trajectory& estimate,
                const std::vector<PosePair>& pairs, const AlignmentOptions& options) {
  if (pairs.empty()) throw std::invalid_argument("no pose of the estimate belongs to the truth");
  std::span<const PosePair> used(pairs);
  if (options.first_n > 0) used = used.first(std::min(options.first_n, used.size()));
  Alignment result = AlignBy(options.method, truth, estimate, used);
  // The first pose alone decides the origin; the others' errors are left.
  const bool by_first = options.method == AlignmentMethod::kOrigin;
  result.leaves_errors = (by_first ? pairs.size() : used.size()) >= FewestPairs(options.method);
  return result;
}

Eigen::Isometry3d Apply(const Alignment& alignment, const Eigen::Isometry3d& T_world_rig) {
  Eigen::Isometry3d result = T_world_rig;
  result.translation() *= alignment.scale;
  return alignment.T_truth_estimate * result;
}

}  // namespace aisle
