#include "slam/map/triangulate_landmarks.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace aisle::slam {
namespace {

constexpr double kChi2OneRow = 3.84;  // 95 % of chi-square with one degree of freedom

Eigen::Vector3d RayOf(const StereoCamera& camera, const Measurement& measurement) {
  return {(measurement.uvd.x() - camera.cx) / camera.fx,
          (measurement.uvd.y() - camera.cy) / camera.fy, 1};
}

/// Features that name no landmark, those in `used` left out.
std::vector<std::size_t> FreeFeatures(const Keyframe& keyframe, const std::vector<bool>& used) {
  std::vector<std::size_t> features;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    if (!keyframe.landmarks[i].valid() && !used[i]) features.push_back(i);
  }
  return features;
}

/// Two keyframes and how one lies to the other.
struct View {
  const Keyframe& here;
  const Keyframe& there;
  const StereoCamera& camera;
  Eigen::Isometry3d T_there_here;

  const Measurement& Here(std::size_t i) const { return here.frame->measurements[i]; }
  const Measurement& There(std::size_t i) const { return there.frame->measurements[i]; }
};

/// A feature that may be met on an epipolar line: what every test of it asks for.
struct Candidate {
  std::size_t feature;
  Eigen::Vector3d ray;
  double variance_px;
  int level;
};

std::vector<Candidate> CandidatesOf(const View& view, const std::vector<std::size_t>& features) {
  std::vector<Candidate> candidates;
  candidates.reserve(features.size());
  for (const std::size_t j : features) {
    const Measurement& measurement = view.There(j);
    candidates.push_back({j, RayOf(view.camera, measurement),
                          measurement.sigma_px * measurement.sigma_px,
                          view.there.frame->features.keypoints[j].level});
  }
  return candidates;
}

/// The candidate that looks most like feature `i` here and lies on its epipolar line.
std::optional<std::size_t> BestOnLine(const View& view, std::size_t i,
                                      const std::vector<Candidate>& candidates,
                                      const TriangulateOptions& options) {
  Eigen::Vector3d line = view.T_there_here.translation().cross(view.T_there_here.linear() *
                                                               RayOf(view.camera, view.Here(i)));
  line *= view.camera.fx / line.head<2>().norm();  // so that line.dot(ray) is in pixels
  const Features& here = view.here.frame->features;
  const Features& there = view.there.frame->features;
  const double variance_px = view.Here(i).sigma_px * view.Here(i).sigma_px;
  std::optional<std::size_t> best;
  int least = options.descriptor_distance + 1, second = 257;
  for (const Candidate& candidate : candidates) {
    const double off_px = line.dot(candidate.ray);
    if (off_px * off_px > kChi2OneRow * (variance_px + candidate.variance_px)) continue;
    if (std::abs(here.keypoints[i].level - candidate.level) > 2) continue;
    const int distance = HammingDistance(here.descriptors[i], there.descriptors[candidate.feature]);
    if (distance < least) {
      second = best ? least : second;
      least = distance;
      best = candidate.feature;
    } else {
      second = std::min(second, distance);
    }
  }
  return best && least <= options.descriptor_ratio * second ? best : std::nullopt;
}

/// The point, as seen from here, nearest to both rays; nothing where they place it too badly.
std::optional<Eigen::Vector3d> Intersect(const View& view, std::size_t i, std::size_t j,
                                         double worst_depth_ratio) {
  const Eigen::Vector3d a = RayOf(view.camera, view.Here(i)).normalized();
  const Eigen::Vector3d b =
      (view.T_there_here.linear().transpose() * RayOf(view.camera, view.There(j))).normalized();
  const Eigen::Vector3d to_there = view.T_there_here.inverse(Eigen::Isometry).translation();
  const double sine = a.cross(b).norm();  // of the parallax
  const double sigma_rad =
      std::hypot(view.Here(i).sigma_px, view.There(j).sigma_px) / view.camera.fx;
  if (sigma_rad > worst_depth_ratio * sine) return std::nullopt;
  const double cosine = a.dot(b);
  const double along_a = (to_there.dot(a) - to_there.dot(b) * cosine) / (sine * sine);
  const double along_b = (to_there.dot(a) * cosine - to_there.dot(b)) / (sine * sine);
  return (along_a * a + to_there + along_b * b) / 2;
}

/// Whether a measurement agrees with a point before its rig, disparity included.
bool Agrees(const StereoCamera& camera, const Eigen::Vector3d& in_rig,
            const Measurement& measurement) {
  constexpr double kChi2Pixel = 5.991, kChi2Stereo = 7.815;
  if (in_rig.z() < 0.1) return false;
  const Eigen::Vector3d error = measurement.uvd - Project(camera, in_rig);
  double chi2 = error.head<2>().squaredNorm() / (measurement.sigma_px * measurement.sigma_px);
  if (!measurement.has_depth()) return chi2 <= kChi2Pixel;
  chi2 += error.z() * error.z() / (measurement.sigma_d * measurement.sigma_d);
  return chi2 <= kChi2Stereo;
}

/// What is nearer is seen larger, at a higher level.
bool SizesFit(const View& view, std::size_t i, std::size_t j, double distance_here,
              double distance_there) {
  constexpr double kSlack = 1.8;
  const int levels =
      view.here.frame->features.keypoints[i].level - view.there.frame->features.keypoints[j].level;
  const double ratio = distance_here / distance_there * std::pow(view.here.frame->scale, levels);
  return ratio < kSlack && ratio > 1 / kSlack;
}

}  // namespace

std::vector<Landmark> TriangulateLandmarks(const Map& map, KeyframeId newest,
                                           const std::vector<KeyframeId>& neighbours,
                                           const StereoCamera& camera,
                                           const TriangulateOptions& options) {
  std::vector<Landmark> landmarks;
  const Keyframe& here = map.At(newest);
  std::vector<bool> used_here(here.landmarks.size(), false);
  for (int n = 0; n < std::min<int>(options.neighbours, static_cast<int>(neighbours.size())); ++n) {
    const Keyframe& there = map.At(neighbours[static_cast<std::size_t>(n)]);
    const View view{here, there, camera, there.T_world_rig.inverse() * here.T_world_rig};
    // Nearer than the two eyes are to each other they see better by themselves.
    if (view.T_there_here.translation().norm() < camera.baseline_m) continue;
    std::vector<bool> used_there(there.landmarks.size(), false);
    const std::vector<Candidate> candidates = CandidatesOf(view, FreeFeatures(there, used_there));
    for (const std::size_t i : FreeFeatures(here, used_here)) {
      const auto j = BestOnLine(view, i, candidates, options);
      if (!j || used_there[*j]) continue;
      const auto point = Intersect(view, i, *j, options.worst_depth_ratio);
      if (!point) continue;
      const Eigen::Vector3d from_there = view.T_there_here * *point;
      if (!Agrees(camera, *point, view.Here(i)) || !Agrees(camera, from_there, view.There(*j)) ||
          !SizesFit(view, i, *j, point->norm(), from_there.norm())) {
        continue;
      }
      used_here[i] = used_there[*j] = true;
      Landmark landmark;
      landmark.position = here.T_world_rig * *point;
      landmark.observations = {{there.id, static_cast<int>(*j)}, {newest, static_cast<int>(i)}};
      landmark.created_by = newest;
      landmark.predicted = landmark.found = 1;
      landmarks.push_back(landmark);
    }
  }
  return landmarks;
}

}  // namespace aisle::slam
