#include "slam/map/match_by_projection.h"

#include <cmath>

#include "slam/map/landmark_view.h"

namespace aisle::slam {
namespace {

/// The best feature for one landmark, feature -1 where there is none good and distinct enough.
Match BestFeature(const Frame& frame, const Expected& expected, const MatchOptions& options) {
  const double radius = options.radius_px * std::pow(frame.scale, expected.level);
  const cv::Point2f pixel(static_cast<float>(expected.uvd.x()),
                          static_cast<float>(expected.uvd.y()));
  Match best{expected.landmark->id, -1, options.descriptor_distance + 1};
  int second = 257, best_level = -1, second_level = -2;
  for (const int candidate :
       frame.grid.Near(pixel, static_cast<float>(radius), expected.level - 1, expected.level + 1)) {
    const auto i = static_cast<std::size_t>(candidate);
    const Measurement& measurement = frame.measurements[i];
    if (measurement.has_depth() && std::abs(measurement.uvd.z() - expected.uvd.z()) > radius) {
      continue;
    }
    const int distance =
        HammingDistance(expected.landmark->descriptor, frame.features.descriptors[i]);
    const int level = frame.features.keypoints[i].level;
    if (distance < best.distance) {
      if (best.feature >= 0) {
        second = best.distance;
        second_level = best_level;
      }
      best.feature = candidate;
      best.distance = distance;
      best_level = level;
    } else if (distance < second) {
      second = distance;
      second_level = level;
    }
  }
  // A neighbour level shows the same corner again: no rival.
  const bool rivalled = second_level == best_level && best.distance > options.ratio * second;
  if (rivalled) best.feature = -1;
  return best;
}

}  // namespace

std::optional<Expected> Expect(const Landmark& landmark, const StereoCamera& camera,
                               const Eigen::Isometry3d& T_rig_world, double scale, int levels) {
  const Eigen::Vector3d in_rig = T_rig_world * landmark.position;
  if (in_rig.z() < kNearestVisible_m) return std::nullopt;
  const Eigen::Vector3d uvd = Project(camera, in_rig);
  if (!InImage(camera, uvd.x(), uvd.y())) return std::nullopt;
  const Eigen::Vector3d centre = T_rig_world.inverse(Eigen::Isometry).translation();
  if (!CanBeSeenFrom(landmark, centre, scale, levels)) return std::nullopt;
  return Expected{&landmark, uvd, PredictLevel(landmark, in_rig.norm(), scale, levels)};
}

std::vector<Expected> ExpectAll(std::span<const Landmark* const> landmarks,
                                const StereoCamera& camera, const Eigen::Isometry3d& T_rig_world,
                                double scale, int levels) {
  std::vector<Expected> expected;
  for (const Landmark* landmark : landmarks) {
    const auto one = Expect(*landmark, camera, T_rig_world, scale, levels);
    if (one) expected.push_back(*one);
  }
  return expected;
}

std::vector<Match> MatchByProjection(const Frame& frame, std::span<const Expected> expected,
                                     const MatchOptions& options) {
  std::vector<Match> by_feature(static_cast<std::size_t>(frame.size()));
  for (const Expected& one : expected) {
    const Match match = BestFeature(frame, one, options);
    if (match.feature < 0) continue;
    Match& held = by_feature[static_cast<std::size_t>(match.feature)];
    if (held.feature < 0 || match.distance < held.distance) held = match;
  }
  std::erase_if(by_feature, [](const Match& match) { return match.feature < 0; });
  return by_feature;
}

}  // namespace aisle::slam
