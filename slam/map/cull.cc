#include "slam/map/cull.h"

#include <algorithm>

#include "slam/map/landmarks_of.h"

namespace aisle::slam {
namespace {

/// Landmarks seen by the keyframe or by its neighbours: those whose fate it may have changed.
std::vector<LandmarkId> LandmarksAround(const Map& map, KeyframeId id) {
  std::vector<KeyframeId> keyframes = {id};
  for (const Covisible& neighbour : CovisibleKeyframes(map, id, 1)) {
    keyframes.push_back(neighbour.keyframe);
  }
  return LandmarksOf(map, keyframes);
}

/// Every keyframe before this one has at least `count` others after it; none where there are not so
/// many. Found once, as the map may be large and is asked of every landmark around.
KeyframeId FirstOfNewest(const Map& map, int count) {
  if (count <= 0) return map.NextKeyframeId();
  const auto& keyframes = map.keyframes();
  if (count > std::ssize(keyframes)) return {};
  return std::prev(keyframes.end(), count)->first;
}

int LevelOf(const Map& map, const Observation& observation) {
  return map.At(observation.keyframe)
      .frame->features.keypoints[static_cast<std::size_t>(observation.feature)]
      .level;
}

bool IsRedundant(const Map& map, const Keyframe& keyframe, const std::set<KeyframeId>& going,
                 const CullOptions& options) {
  int landmarks = 0, elsewhere = 0;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const Landmark* landmark = map.Find(keyframe.landmarks[i]);
    if (!landmark || !keyframe.frame->measurements[i].has_depth()) continue;
    ++landmarks;
    elsewhere += SeenElsewhere(map, *landmark, {keyframe.id, static_cast<int>(i)}, going,
                               options.redundant_observers);
  }
  return elsewhere > options.redundant_share * landmarks;
}

}  // namespace

bool SeenElsewhere(const Map& map, const Landmark& landmark, const Observation& own,
                   const std::set<KeyframeId>& going, int observers) {
  const int level = LevelOf(map, own);
  const auto others = std::ranges::count_if(landmark.observations, [&](const Observation& other) {
    return other.keyframe != own.keyframe && !going.contains(other.keyframe) &&
           LevelOf(map, other) <= level + 1;
  });
  return others >= observers;
}

MapEdit CullLandmarks(const Map& map, KeyframeId newest, const CullOptions& options) {
  MapEdit edit;
  const KeyframeId probation = FirstOfNewest(map, options.probation_keyframes);
  for (const LandmarkId id : LandmarksAround(map, newest)) {
    const Landmark& landmark = map.At(id);
    const bool rarely_found = landmark.found < options.least_found_ratio * landmark.predicted;
    const bool unconfirmed = landmark.created_by < probation &&
                             (landmark.observations.size() < 2 ||
                              ObservationWeight(map, landmark) < options.least_weight);
    if (rarely_found || unconfirmed) edit.removed_landmarks.push_back(id);
  }
  return edit;
}

MapEdit CullKeyframes(const Map& map, KeyframeId newest, const CullOptions& options) {
  MapEdit edit;
  const KeyframeId recent = FirstOfNewest(map, options.recent_keyframes);
  std::set<KeyframeId> going;
  for (const Covisible& neighbour : CovisibleKeyframes(map, newest, 1)) {
    const KeyframeId id = neighbour.keyframe;
    const bool is_root = !map.At(id).parent.valid();  // a part of the map hangs on it
    if (is_root || id >= recent) continue;
    if (IsRedundant(map, map.At(id), going, options)) going.insert(id);
  }
  edit.removed_keyframes.assign(going.begin(), going.end());
  return edit;
}

}  // namespace aisle::slam
