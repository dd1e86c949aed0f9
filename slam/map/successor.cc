#include "slam/map/successor.h"

#include <algorithm>

#include "slam/camera/se3.h"

namespace aisle::slam {
namespace {

/// Whether a keyframe sees both with one feature: then they are the same landmark.
bool SharesObservation(const Landmark& before, const Landmark& now) {
  return std::ranges::any_of(before.observations, [&](const Observation& one) {
    return std::ranges::binary_search(now.observations, one);
  });
}

/// The world around its parent may have moved, as far as a loop was wide: the keyframe and what it
/// has brought go with it. To the last bit they stay where it has not.
void MoveWithParent(const Map& before, const Map& now, Keyframe& keyframe,
                    std::vector<Landmark>& brought) {
  const Eigen::Isometry3d T_then = before.PoseOf(keyframe.parent);
  const Eigen::Isometry3d T_now = now.PoseOf(keyframe.parent);
  if (T_now.matrix() == T_then.matrix()) return;
  const Eigen::Isometry3d T_new_old = T_now * T_then.inverse();
  keyframe.T_world_rig = Normalized(T_new_old * keyframe.T_world_rig);
  for (Landmark& landmark : brought) landmark.position = T_new_old * landmark.position;
}

}  // namespace

LandmarkId Successor(const Map& before, const Map& now, LandmarkId id) {
  const Landmark* old = before.Find(id);
  if (!old) return {};
  // The two maps may have given the same id to different landmarks since they parted. The keyframe
  // that brought them does not tell, as it brings many: where it was added to both, its landmarks
  // have the ids of one another.
  const Landmark* same = now.Find(id);
  if (same && same->created_by != old->created_by) same = nullptr;
  if (same && SharesObservation(*old, *same)) return id;
  for (const Observation& observation : old->observations) {
    const Keyframe* keyframe = now.Find(observation.keyframe);
    if (!keyframe) continue;
    const LandmarkId there = keyframe->landmarks[static_cast<std::size_t>(observation.feature)];
    if (there.valid()) return there;
  }
  // A keyframe that was added to both still sees all its landmarks: this one was in both before,
  // and has only lost those who saw it then.
  return same ? id : LandmarkId{};
}

MapEdit CarriedOver(MapEdit edit, const Map& before, const Map& now) {
  for (Keyframe& keyframe : edit.new_keyframes) {
    if (keyframe.parent.valid()) {
      MoveWithParent(before, now, keyframe, edit.new_landmarks);
      keyframe.parent = now.StandIn(keyframe.parent);
    }
    for (LandmarkId& landmark : keyframe.landmarks) {
      if (landmark.valid()) landmark = Successor(before, now, landmark);
    }
  }
  for (MapEdit::Count& count : edit.counts) count.landmark = Successor(before, now, count.landmark);
  return edit;
}

}  // namespace aisle::slam
