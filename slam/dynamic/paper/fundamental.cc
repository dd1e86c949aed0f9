#include "slam/dynamic/paper/fundamental.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "slam/dynamic/common/counter_random.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kSample = 9;
constexpr int kRefits = 3;

Eigen::Vector3d Homogeneous(const cv::Point2f& p) { return {p.x, p.y, 1.0}; }

/// Moves points to their centroid and scales their mean distance to sqrt(2).
Eigen::Matrix3d Normalizer(std::span<const Track> tracks, cv::Point2f Track::*end) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Track& t : tracks) mean += Homogeneous(t.*end).head<2>();
  mean /= static_cast<double>(tracks.size());
  double spread = 0;
  for (const Track& t : tracks) spread += (Homogeneous(t.*end).head<2>() - mean).norm();
  spread /= static_cast<double>(tracks.size());
  const double scale = spread > 1e-9 ? std::sqrt(2.0) / spread : 1.0;
  Eigen::Matrix3d T;
  T << scale, 0, -scale * mean.x(), 0, scale, -scale * mean.y(), 0, 0, 1;
  return T;
}

Eigen::Matrix3d WithRankTwo(const Eigen::Matrix3d& F) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d values = svd.singularValues();
  values[2] = 0;
  return svd.matrixU() * values.asDiagonal() * svd.matrixV().transpose();
}

struct Support {
  std::vector<bool> is_inlier;
  int inliers = 0;
  double sum_px = 0;  // of the inliers' distances: decides between equal counts
};

Support SupportOf(const Eigen::Matrix3d& F, const std::vector<Track>& tracks, double inlier_px) {
  Support support;
  support.is_inlier.reserve(tracks.size());
  for (const Track& track : tracks) {
    const double distance = EpipolarDistance(F, track);
    const bool inlier = distance <= inlier_px;
    support.is_inlier.push_back(inlier);
    support.inliers += inlier ? 1 : 0;
    support.sum_px += inlier ? distance : 0;
  }
  return support;
}

bool Better(const Support& a, const Support& b) {
  return a.inliers != b.inliers ? a.inliers > b.inliers : a.sum_px < b.sum_px;
}

std::vector<Track> Kept(const std::vector<Track>& tracks, const std::vector<bool>& keep) {
  std::vector<Track> kept;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (keep[i]) kept.push_back(tracks[i]);
  }
  return kept;
}

int IterationsNeeded(double inlier_share, const FundamentalOptions& options) {
  const double clean = std::pow(inlier_share, kSample);
  if (clean >= 1.0 - 1e-12) return 1;
  const double needed = std::log(1 - options.confidence) / std::log1p(-clean);
  return needed < options.max_iterations ? static_cast<int>(std::ceil(needed))
                                         : options.max_iterations;
}

}  // namespace

double EpipolarDistance(const Eigen::Matrix3d& F, const Track& track) {
  const Eigen::Vector3d line = F * Homogeneous(track.previous);  // Equation (1)
  const double norm = line.head<2>().norm();
  return norm > 1e-15 ? std::abs(line.dot(Homogeneous(track.current))) / norm : 0;  // Equation (2)
}

double DistanceFromStatic(const FundamentalEstimate& estimate, const Track& track) {
  return estimate.standing ? cv::norm(track.current - track.previous)
                           : EpipolarDistance(estimate.F, track);
}

Eigen::Matrix3d FundamentalFromTracks(std::span<const Track> tracks) {
  CV_Assert(tracks.size() >= kSample);
  const Eigen::Matrix3d T_previous = Normalizer(tracks, &Track::previous);
  const Eigen::Matrix3d T_current = Normalizer(tracks, &Track::current);
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (const Track& track : tracks) {
    const Eigen::Vector3d p = T_previous * Homogeneous(track.previous);
    const Eigen::Vector3d c = T_current * Homogeneous(track.current);
    Eigen::Matrix<double, 9, 1> row;
    for (int k = 0; k < 9; ++k) row[k] = c[k / 3] * p[k % 3];
    normal.noalias() += row * row.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  const Eigen::Matrix<double, 9, 1> f = solver.eigenvectors().col(0);
  Eigen::Matrix3d normalized;
  normalized << f.segment<3>(0).transpose(), f.segment<3>(3).transpose(),
      f.segment<3>(6).transpose();
  const Eigen::Matrix3d F = T_current.transpose() * WithRankTwo(normalized) * T_previous;
  return F / F.norm();
}

FundamentalEstimate EstimateFundamental(const std::vector<Track>& tracks,
                                        const FundamentalOptions& options) {
  FundamentalEstimate estimate;
  estimate.is_inlier.assign(tracks.size(), false);
  const int count = static_cast<int>(tracks.size());
  if (count < kSample) return estimate;

  Support best;
  int needed = options.max_iterations;
  for (int k = 0; k < needed; ++k) {
    CounterRandom random(options.seed, static_cast<std::uint64_t>(k));
    std::array<Track, kSample> sample;
    const auto drawn = random.Distinct<kSample>(count);
    std::transform(drawn.begin(), drawn.end(), sample.begin(),
                   [&](int i) { return tracks[static_cast<std::size_t>(i)]; });
    const Eigen::Matrix3d F = FundamentalFromTracks(sample);
    Support support = SupportOf(F, tracks, options.inlier_px);
    if (Better(support, best)) {
      best = std::move(support);
      estimate.F = F;
      needed =
          std::min(needed, IterationsNeeded(static_cast<double>(best.inliers) / count, options));
    }
    estimate.iterations = k + 1;
  }

  for (int round = 0; round < kRefits && best.inliers >= kSample; ++round) {
    const Eigen::Matrix3d F = FundamentalFromTracks(Kept(tracks, best.is_inlier));
    Support support = SupportOf(F, tracks, options.inlier_px);
    if (!Better(support, best)) break;
    best = std::move(support);
    estimate.F = F;
  }
  estimate.found = best.inliers >= kSample;
  estimate.inliers = best.inliers;
  estimate.standing = MedianFlow(tracks) < options.standing_flow_px;
  if (!best.is_inlier.empty()) estimate.is_inlier = best.is_inlier;
  return estimate;
}

}  // namespace aisle::slam::dynamic
