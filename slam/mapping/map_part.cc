#include "slam/mapping/map_part.h"

namespace aisle::slam {

std::optional<NewPart> BeginPart(const Map& map, const std::shared_ptr<const Frame>& frame,
                                 const Eigen::Isometry3d& T_world_rig, const StereoCamera& camera,
                                 const NewPartOptions& options) {
  NewPart part;
  part.anew = !options.keeps_world && std::ssize(map.keyframes()) < options.least_keyframes;
  Keyframe keyframe;
  keyframe.id = part.anew ? KeyframeId{0} : map.NextKeyframeId();
  keyframe.frame = frame;
  keyframe.T_world_rig = T_world_rig;
  keyframe.landmarks.resize(static_cast<std::size_t>(frame->size()));
  part.edit.new_landmarks = CreateLandmarks(keyframe, camera, options.create);
  if (std::ssize(part.edit.new_landmarks) < options.least_points) return std::nullopt;
  part.edit.new_keyframes = {std::move(keyframe)};
  return part;
}

bool IsInFirstPart(const Map& map, KeyframeId id) {
  // Asked of every frame, and the way to the root is as long as the drive.
  return map.part_count() == 1 || RootOf(map, map.StandIn(id)) == map.keyframes().begin()->first;
}

}  // namespace aisle::slam
