#include "slam/base/plain_tracking.h"

#include "slam/track/keyframe_policy.h"
#include "slam/track/predict_motion.h"

namespace aisle::slam {

std::optional<FramePose> PlainTracking::Find(const std::shared_ptr<const Frame>& frame,
                                             const DriveState& drive) {
  const PlainContext context{drive.map, *frame, camera_, options_.feature.levels, options_.track};
  if (!drive.lost) return TrackFrame(context, drive.memory);
  return Relocalise(context, drive.memory, drive.places, drive.frame_number);
}

KeyframeVerdict PlainTracking::NeedsKeyframe(const Map& map, const Frame& frame,
                                             const FramePose& pose,
                                             const MapperState& mapper) const {
  // One job at a time: the next keyframe waits for the appointed frame, not for a thread.
  const bool taken =
      mapper.idle && slam::NeedsKeyframe(map, frame, pose, camera_, options_.keyframe);
  return {.taken = taken};
}

MapEdit PlainTracking::MakeKeyframe(const Map& map, const std::shared_ptr<const Frame>& frame,
                                    const FramePose& pose) const {
  Keyframe keyframe = KeyframeOf(map, frame, pose);
  MapEdit edit;
  edit.new_landmarks = CreateLandmarks(keyframe, camera_, options_.mapping.create);
  edit.new_keyframes = {std::move(keyframe)};
  return edit;
}

std::optional<NewPart> PlainTracking::Begin(const std::shared_ptr<const Frame>& frame,
                                            const DriveState& drive) const {
  const Eigen::Isometry3d T_world_rig =
      ReckonedPose(drive.map, drive.memory, frame->stamp_ns, options_.track);
  return BeginPart(drive.map, frame, T_world_rig, camera_,
                   {.create = options_.mapping.create,
                    .least_points = options_.least_first_points,
                    .least_keyframes = options_.least_keyframes,
                    .keeps_world = !options_.map_file.empty()});
}

}  // namespace aisle::slam
