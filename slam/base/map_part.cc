#include "slam/base/map_part.h"

#include <algorithm>

namespace aisle::slam {

std::optional<NewPart> BeginPart(const Map& map, const std::shared_ptr<const Frame>& frame,
                                 const TrackMemory& memory, const StereoCamera& camera,
                                 const SlamOptions& options) {
  NewPart part;
  part.anew = options.map_file.empty() && std::ssize(map.keyframes()) < options.least_keyframes;
  Keyframe keyframe;
  keyframe.id = part.anew ? KeyframeId{0} : map.NextKeyframeId();
  keyframe.frame = frame;
  if (!map.empty()) {
    const double gap_s = static_cast<double>(frame->stamp_ns - memory.stamp_ns) * 1e-9;
    keyframe.T_world_rig = PredictPose(map.PoseOf(memory.reference) * memory.T_reference_rig,
                                       memory.motion, std::min(gap_s, options.track.longest_gap_s));
  }
  keyframe.landmarks.resize(static_cast<std::size_t>(frame->size()));
  part.edit.new_landmarks = CreateLandmarks(keyframe, camera, options.mapping.create);
  if (std::ssize(part.edit.new_landmarks) < options.least_first_points) return std::nullopt;
  part.edit.new_keyframes = {std::move(keyframe)};
  return part;
}

FramePose PoseOfKeyframe(const Map& map, KeyframeId id) {
  const Keyframe& keyframe = map.At(id);
  FramePose pose;
  pose.pose.T_rig_world = keyframe.T_world_rig.inverse();
  pose.local.reference = id;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const LandmarkId landmark = keyframe.landmarks[i];
    if (landmark.valid()) pose.matches.push_back({landmark, static_cast<int>(i), 0});
  }
  pose.pose.inliers = static_cast<int>(pose.matches.size());
  pose.pose.inlier.assign(pose.matches.size(), true);
  return pose;
}

MapEdit KeyframeFrom(const Map& map, const std::shared_ptr<const Frame>& frame,
                     const FramePose& pose, const StereoCamera& camera,
                     const CreateLandmarksOptions& options) {
  Keyframe keyframe = KeyframeOf(map, frame, pose);
  MapEdit edit;
  edit.new_landmarks = CreateLandmarks(keyframe, camera, options);
  edit.new_keyframes = {std::move(keyframe)};
  return edit;
}

bool IsInFirstPart(const Map& map, KeyframeId id) {
  return RootOf(map, map.StandIn(id)) == map.keyframes().begin()->first;
}

}  // namespace aisle::slam
