#include "slam/map/two_views.h"

#include <algorithm>
#include <cmath>

namespace aisle::slam {
namespace {

constexpr double kChi2OneRow = 3.84;  // 95 % of chi-square with one degree of freedom

}  // namespace

Eigen::Vector3d RayOf(const StereoCamera& camera, const Measurement& measurement) {
  return {(measurement.uvd.x() - camera.cx) / camera.fx,
          (measurement.uvd.y() - camera.cy) / camera.fy, 1};
}

std::vector<std::size_t> FreeFeatures(const Keyframe& keyframe, const std::vector<bool>& used) {
  std::vector<std::size_t> features;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    if (!keyframe.landmarks[i].valid() && !used[i]) features.push_back(i);
  }
  return features;
}

std::vector<LineCandidate> CandidatesOf(const TwoViews& views,
                                        const std::vector<std::size_t>& features) {
  std::vector<LineCandidate> candidates;
  candidates.reserve(features.size());
  for (const std::size_t j : features) {
    const Measurement& measurement = views.There(j);
    candidates.push_back({j, RayOf(views.camera, measurement),
                          measurement.sigma_px * measurement.sigma_px,
                          views.there.frame->features.keypoints[j].level});
  }
  return candidates;
}

std::optional<std::size_t> BestOnLine(const TwoViews& views, std::size_t i,
                                      const std::vector<LineCandidate>& candidates, int distance,
                                      double ratio) {
  Eigen::Vector3d line = views.T_there_here.translation().cross(views.T_there_here.linear() *
                                                                RayOf(views.camera, views.Here(i)));
  line *= views.camera.fx / line.head<2>().norm();  // so that line.dot(ray) is in pixels
  const Features& here = views.here.frame->features;
  const Features& there = views.there.frame->features;
  const double variance_px = views.Here(i).sigma_px * views.Here(i).sigma_px;
  std::optional<std::size_t> best;
  int least = distance + 1, second = 257;
  for (const LineCandidate& candidate : candidates) {
    const double off_px = line.dot(candidate.ray);
    if (off_px * off_px > kChi2OneRow * (variance_px + candidate.variance_px)) continue;
    if (std::abs(here.keypoints[i].level - candidate.level) > 2) continue;
    const int bits = HammingDistance(here.descriptors[i], there.descriptors[candidate.feature]);
    if (bits < least) {
      second = best ? least : second;
      least = bits;
      best = candidate.feature;
    } else {
      second = std::min(second, bits);
    }
  }
  return best && least <= ratio * second ? best : std::nullopt;
}

Intersection Intersect(const TwoViews& views, std::size_t i, std::size_t j) {
  const Eigen::Vector3d a = RayOf(views.camera, views.Here(i)).normalized();
  const Eigen::Vector3d b =
      (views.T_there_here.linear().transpose() * RayOf(views.camera, views.There(j))).normalized();
  const Eigen::Vector3d to_there = views.T_there_here.inverse(Eigen::Isometry).translation();
  const double sine = a.cross(b).norm();
  const double cosine = a.dot(b);
  const double along_a = (to_there.dot(a) - to_there.dot(b) * cosine) / (sine * sine);
  const double along_b = (to_there.dot(a) * cosine - to_there.dot(b)) / (sine * sine);
  return {sine, (along_a * a + to_there + along_b * b) / 2};
}

bool Agrees(const StereoCamera& camera, const Eigen::Vector3d& in_rig,
            const Measurement& measurement) {
  if (in_rig.z() < kNearestTrusted_m) return false;
  const Eigen::Vector3d error = measurement.uvd - Project(camera, in_rig);
  double chi2 = error.head<2>().squaredNorm() / (measurement.sigma_px * measurement.sigma_px);
  if (measurement.has_depth()) {
    const double error_d = error.z() - measurement.u_in_d * error.x();
    chi2 += error_d * error_d / (measurement.sigma_d * measurement.sigma_d);
  }
  return chi2 <= Chi2Bound(measurement);
}

bool SizesFit(const TwoViews& views, std::size_t i, std::size_t j, double distance_here,
              double distance_there) {
  constexpr double kSlack = 1.8;
  const int levels = views.here.frame->features.keypoints[i].level -
                     views.there.frame->features.keypoints[j].level;
  const double ratio = distance_here / distance_there * std::pow(views.here.frame->scale, levels);
  return ratio < kSlack && ratio > 1 / kSlack;
}

}  // namespace aisle::slam
