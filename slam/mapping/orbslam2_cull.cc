#include <set>

#include "slam/map/cull.h"
#include "slam/mapping/orbslam2_mapping.h"

namespace aisle::slam {
namespace {

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
  std::set<KeyframeId> going;
  for (const Covisible& neighbour : CovisibleKeyframes(map, newest, kLeastCovisible)) {
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
