#include "slam/base/plain_tracking.h"

#include "slam/track/keyframe_policy.h"
#include "slam/track/predict_motion.h"
#include "slam/track/track_measured.h"

namespace aisle::slam {

std::optional<FramePose> PlainTracking::Find(const std::shared_ptr<const Frame>& frame,
                                             const DriveState& drive) {
  const PlainContext context{drive.map,      *frame,      camera_,     options_.feature.levels,
                             options_.track, drive.right, drive.masked};
  if (drive.memory.measured)
    return TrackMeasured(context, drive.memory, drive.places, drive.frame_number);
  if (drive.in_prior_map) {
    if (auto found = TrackInPriorMap(context, drive.memory, *drive.in_prior_map)) return found;
  }
  if (!drive.lost) return TrackCarried(context, drive.memory, drive.places, drive.frame_number);
  return Relocalise(LeftAlone(context), drive.memory, drive.places, drive.frame_number);
}

KeyframeVerdict PlainTracking::NeedsKeyframe(const Map& map, const Frame& frame,
                                             const FramePose& pose,
                                             const MapperState& mapper) const {
  // One job at a time: the next keyframe waits for the appointed frame, not for a thread; one that
  // is needed at once waits for it in the map.
  const bool taken = mapper.idle
                         ? slam::NeedsKeyframe(map, frame, pose, camera_, options_.keyframe)
                         : !mapper.closing && mapper.waiting == 0 &&
                               NeedsKeyframeAtOnce(map, frame, pose, camera_, options_.keyframe);
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

std::optional<MapEdit> PlainTracking::Extend(const std::shared_ptr<const Frame>& frame,
                                             const DriveState& drive) const {
  const Eigen::Isometry3d T_world_rig =
      drive.memory.PoseIn(drive.map) * drive.memory.Way().T_now_before.inverse();
  Keyframe keyframe;
  keyframe.id = drive.map.NextKeyframeId();
  keyframe.frame = frame;
  keyframe.T_world_rig = Normalized(T_world_rig);
  keyframe.parent = drive.map.StandIn(drive.memory.reference);
  keyframe.landmarks.resize(static_cast<std::size_t>(frame->size()));
  MapEdit edit;
  edit.new_landmarks = CreateLandmarks(keyframe, camera_, options_.mapping.create);
  if (std::ssize(edit.new_landmarks) < options_.least_first_points) return std::nullopt;
  edit.new_keyframes = {std::move(keyframe)};
  return edit;
}

}  // namespace aisle::slam
