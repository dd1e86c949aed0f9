#include "slam/dynamic/scene_flow.h"

#include <Eigen/LU>
#include <numbers>

namespace aisle::slam::dynamic {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Volume in (u, v, disparity), cubic pixels, over which the errors of movers are spread.
constexpr double kMoverVolume = 24.0 * 12.0 * 3.0;
constexpr int kLeastForNoise = 20;

/// Derivative of the inverse projection: rows x, y, z, columns u, v, disparity.
Matrix3d BackprojectionJacobian(const StereoCamera& camera, const Vector3d& uvd) {
  const Vector3d point = Backproject(camera, uvd);
  Matrix3d jacobian = Matrix3d::Zero();
  jacobian(0, 0) = point.z() / camera.fx;
  jacobian(1, 1) = point.z() / camera.fy;
  jacobian.col(2) = -point / uvd.z();
  return jacobian;
}

/// The deviation of a normal error whose absolute value lies below three quarters of the values:
/// of the body of static points, tails of bad tracks included as far as the quarter allows.
double DeviationOf(std::vector<double>& values) {
  const auto quarter = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 3 / 4);
  std::nth_element(values.begin(), quarter, values.end());
  return *quarter / 1.1503;
}

}  // namespace

double SceneFlowChi2(const StereoCamera& camera, const GapMotion& gap, const Vector3d& before,
                     const Vector3d& now, double noise_per_displacement) {
  const Vector3d point = gap.motion.T_now_before * Backproject(camera, before);
  if (point.z() < 0.05) return std::numeric_limits<double>::infinity();
  const Matrix3d projection = ProjectionJacobian(camera, point);
  const Matrix3d from_before =
      projection * gap.motion.T_now_before.linear() * BackprojectionJacobian(camera, before);
  Eigen::Matrix<double, 3, 6> from_motion;
  from_motion.leftCols<3>() = projection;
  from_motion.rightCols<3>() = -projection * Skew(point);
  const double way = noise_per_displacement * (now - before).head<2>().norm();
  const Vector3d along(way * way, way * way, 0);
  const Matrix3d variance = (gap.noise.cwiseAbs2() + along).asDiagonal();
  const Matrix3d covariance = variance + from_before * variance * from_before.transpose() +
                              from_motion * gap.motion.covariance * from_motion.transpose();
  const Vector3d error = now - Project(camera, point);
  return error.dot(covariance.inverse() * error);
}

double MotionLogOdds(double chi2, const MeasurementNoise& noise) {
  const double volume = std::pow(4 * std::numbers::pi, 1.5) * noise.prod();  // sqrt|2 pi 2 Sigma|
  return 0.5 * chi2 - std::log(kMoverVolume / volume);
}

namespace {

/// What of a point's place the rig's motion over a gap leaves unexplained, in units of noise; zero
/// where that is not known.
Vector3d Unexplained(const StereoCamera& camera, const GapMotion& gap, const PointTrack& track) {
  const Vector3d* before = track.Before(gap.gap);
  if (before == nullptr || !gap.motion.found) return Vector3d::Zero();
  const Vector3d point = gap.motion.T_now_before * Backproject(camera, *before);
  if (point.z() < 0.05) return Vector3d::Zero();
  return (track.now() - Project(camera, point)).cwiseQuotient(gap.noise);
}

/// Whether the way over a long gap was not gone steadily: all of it or none of it in the short gap
/// that ends it. A track that has slipped onto another edge does this, a mover seldom.
bool HasJumped(const Vector3d& over_short, const Vector3d& over_long,
               const EvidenceOptions& options) {
  if (over_short.isZero() || over_long.isZero()) return false;
  const double share = over_short.dot(over_long) / over_long.squaredNorm();
  return share < options.least_late_share || share > options.most_late_share;
}

}  // namespace

std::vector<double> PointEvidence(const std::vector<PointTrack>& tracks, const StereoCamera& camera,
                                  const std::vector<GapMotion>& gaps,
                                  const EvidenceOptions& options) {
  std::vector<double> evidence(tracks.size(), 0.0);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    double largest = 0, sum = 0;
    int known = 0;
    Vector3d shorter = Vector3d::Zero();
    for (const GapMotion& gap : gaps) {
      const Vector3d unexplained = Unexplained(camera, gap, tracks[i]);
      const bool jumped = HasJumped(shorter, unexplained, options);
      shorter = unexplained;
      const Vector3d* before = tracks[i].Before(gap.gap);
      if (before == nullptr || !gap.motion.found) continue;
      const auto k =
          static_cast<std::size_t>(std::find(kGaps.begin(), kGaps.end(), gap.gap) - kGaps.begin());
      const double chi2 =
          SceneFlowChi2(camera, gap, *before, tracks[i].now(), options.noise_per_displacement);
      double log_odds = std::clamp(MotionLogOdds(chi2, gap.noise), options.point_static[k],
                                   options.point_dynamic[k]);
      if (jumped) log_odds = std::min(log_odds, 0.0);
      largest = std::max(largest, log_odds);
      sum += log_odds;
      ++known;
    }
    if (known > 0) evidence[i] = largest > 0 ? largest : sum / known;
  }
  return evidence;
}

std::optional<MeasurementNoise> MeasureNoise(const std::vector<PointTrack>& tracks,
                                             const StereoCamera& camera, int gap,
                                             const Eigen::Isometry3d& T_now_before) {
  std::array<std::vector<double>, 3> errors;
  for (const PointTrack& track : tracks) {
    const Vector3d* before = track.Before(gap);
    if (before == nullptr || track.log_odds > 0) continue;
    const Vector3d point = T_now_before * Backproject(camera, *before);
    if (point.z() < 0.05) continue;
    const Vector3d error = (track.now() - Project(camera, point)).cwiseAbs();
    for (std::size_t k = 0; k < 3; ++k) errors[k].push_back(error[static_cast<int>(k)]);
  }
  if (std::ssize(errors[0]) < kLeastForNoise) return std::nullopt;
  MeasurementNoise noise;
  for (std::size_t k = 0; k < 3; ++k) {
    noise[static_cast<int>(k)] = DeviationOf(errors[k]) / std::sqrt(2.0);
  }
  return noise;
}

}  // namespace aisle::slam::dynamic
