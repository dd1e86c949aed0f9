#include "slam/map/successor.h"

namespace aisle::slam {

LandmarkId Successor(const Map& before, const Map& now, LandmarkId id) {
  const Landmark* old = before.Find(id);
  if (!old) return {};
  const Landmark* same = now.Find(id);
  // The two maps may have given the same id to different landmarks since they parted.
  if (same && same->created_by == old->created_by) return id;
  for (const Observation& observation : old->observations) {
    const Keyframe* keyframe = now.Find(observation.keyframe);
    if (!keyframe) continue;
    const LandmarkId there = keyframe->landmarks[static_cast<std::size_t>(observation.feature)];
    if (there.valid()) return there;
  }
  return {};
}

MapEdit CarriedOver(MapEdit edit, const Map& before, const Map& now) {
  for (Keyframe& keyframe : edit.new_keyframes) {
    if (keyframe.parent.valid()) keyframe.parent = now.StandIn(keyframe.parent);
    for (LandmarkId& landmark : keyframe.landmarks) {
      if (landmark.valid()) landmark = Successor(before, now, landmark);
    }
  }
  for (MapEdit::Count& count : edit.counts) count.landmark = Successor(before, now, count.landmark);
  return edit;
}

}  // namespace aisle::slam
