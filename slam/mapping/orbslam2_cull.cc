#include <algorithm>
#include <set>

#include "slam/mapping/orbslam2_mapping.h"

namespace aisle::slam {
namespace {

int LevelOf(const Map& map, const Observation& observation) {
  return map.At(observation.keyframe)
      .frame->features.keypoints[static_cast<std::size_t>(observation.feature)]
      .level;
}

/// Whether enough other keyframes that stay see the landmark at the same scale or a finer one.
bool SeenElsewhere(const Map& map, const Landmark& landmark, const Observation& own,
                   const std::set<KeyframeId>& going, int observers) {
  const int level = LevelOf(map, own);
  const auto others = std::ranges::count_if(landmark.observations, [&](const Observation& other) {
    return other.keyframe != own.keyframe && !going.contains(other.keyframe) &&
           LevelOf(map, other) <= level + 1;
  });
  return others >= observers;
}

bool IsRedundant(const Map& map, const Keyframe& keyframe, const std::set<KeyframeId>& going,
                 double least_disparity, const OrbSlam2MappingOptions& options) {
  int landmarks = 0, elsewhere = 0;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const Landmark* landmark = map.Find(keyframe.landmarks[i]);
    const Measurement& measurement = keyframe.frame->measurements[i];
    if (!landmark || !measurement.has_depth() || measurement.uvd.z() < least_disparity) continue;
    ++landmarks;
    elsewhere += SeenElsewhere(map, *landmark, {keyframe.id, static_cast<int>(i)}, going,
                               options.redundant_observers);
  }
  return elsewhere > options.redundant_share * landmarks;
}

}  // namespace

MapEdit OrbSlam2CullLandmarks(const Map& map, KeyframeId newest,
                              const OrbSlam2MappingOptions& options) {
  MapEdit edit;
  for (const Landmark* landmark : map.Landmarks()) {
    const std::int64_t age = newest.value - landmark->created_by.value;
    if (age > options.probation || age < 0) continue;
    const bool rarely_found = landmark->found < options.least_found_ratio * landmark->predicted;
    const bool unconfirmed = age >= options.confirmed_after &&
                             ObservationWeight(map, *landmark) < options.least_confirmed_weight;
    if (rarely_found || unconfirmed) edit.removed_landmarks.push_back(landmark->id);
  }
  return edit;
}

MapEdit OrbSlam2CullKeyframes(const Map& map, KeyframeId newest, const StereoCamera& camera,
                              const OrbSlam2MappingOptions& options) {
  constexpr int kLeastShared = 15;  // landmarks; fewer make no neighbours
  std::set<KeyframeId> going;
  for (const Covisible& neighbour : CovisibleKeyframes(map, newest, kLeastShared)) {
    const Keyframe& keyframe = map.At(neighbour.keyframe);
    if (!keyframe.parent.valid()) continue;  // the world begins with it
    if (IsRedundant(map, keyframe, going, camera.fx / options.close_baselines, options)) {
      going.insert(keyframe.id);
    }
  }
  MapEdit edit;
  edit.removed_keyframes.assign(going.begin(), going.end());
  return edit;
}

MapEdit OrbSlam2DropUnsupported(const Map& map, const std::vector<LandmarkId>& landmarks,
                                const OrbSlam2MappingOptions& options) {
  MapEdit edit;
  for (const LandmarkId id : landmarks) {
    const Landmark* landmark = map.Find(id);
    if (landmark && ObservationWeight(map, *landmark) < options.least_weight) {
      edit.removed_landmarks.push_back(id);
    }
  }
  return edit;
}

}  // namespace aisle::slam
