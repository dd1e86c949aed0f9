#include "slam/base/plain_tracking.h"

#include "slam/track/keyframe_policy.h"

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
  return KeyframeFrom(map, frame, pose, camera_, options_.mapping.create);
}

std::optional<NewPart> PlainTracking::Begin(const std::shared_ptr<const Frame>& frame,
                                            const DriveState& drive) const {
  return BeginPart(drive.map, frame, drive.memory, camera_, options_);
}

}  // namespace aisle::slam
