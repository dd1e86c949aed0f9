#pragma once

#include <memory>
#include <optional>

#include "slam/mapping/map_part.h"
#include "slam/options/slam_options.h"
#include "slam/track/prior_map.h"
#include "slam/track/relocalise.h"

namespace aisle::slam {

/// What a tracking policy builds upon besides the frame: the drive so far.
struct DriveState {
  const Map& map;
  const TrackMemory& memory;  ///< of the last frame that was found
  Places places;
  std::int64_t frame_number = 0;  ///< since the drive began
  bool lost = false;
  std::optional<PoseInPriorMap> in_prior_map = {};  ///< where the frame that has come was found
  const Frame* right = nullptr;  ///< the frame that has come, as the right camera sees it by itself
  const MaskedArea* masked = nullptr;  ///< where no features of its left image are taken
};

/// How busy the mapper is.
struct MapperState {
  bool idle = true;
  bool closing = false;  ///< a loop: no keyframe can be taken
  int waiting = 0;       ///< keyframes
};

/// Whether a frame is to become a keyframe.
struct KeyframeVerdict {
  bool taken = false;
  bool hurry = false;  ///< the mapper shall leave out what it may
};

/// How a base finds frames and chooses keyframes; everything else of a drive is common to all. One
/// per drive: it may remember what it needs.
class TrackingPolicy {
 public:
  virtual ~TrackingPolicy() = default;

  /// Where the frame stands in the map; nothing if lost.
  virtual std::optional<FramePose> Find(const std::shared_ptr<const Frame>& frame,
                                        const DriveState& drive) = 0;
  /// Whether a frame that was found at `pose` is to join the map.
  virtual KeyframeVerdict NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                                        const MapperState& mapper) const = 0;
  /// The keyframe that it becomes, with the landmarks that it has found and those that it brings.
  virtual MapEdit MakeKeyframe(const Map& map, const std::shared_ptr<const Frame>& frame,
                               const FramePose& pose) const = 0;

  /// The keyframe that begins a map; nothing where the frame shows too little.
  virtual std::optional<NewPart> Begin(const std::shared_ptr<const Frame>& frame,
                                       const DriveState& drive) const = 0;
  /// The keyframe that goes on with the map where the frame is measured to be, though it sees
  /// nothing of it; nothing where the frame shows too little.
  virtual std::optional<MapEdit> Extend(const std::shared_ptr<const Frame>& frame,
                                        const DriveState& drive) const = 0;
  /// Whether a lost rig may begin another part of the map.
  virtual bool BeginsParts() const = 0;
  /// Whether the map of a rig that has just been lost is not worth keeping.
  virtual bool GivesUp(const Map& map) const = 0;

  /// What the next frame has to know of this one; `pose`: null if lost; `drive` as it was before,
  /// its map as it is now; `keyframe`: what it has become, if it has.
  virtual void Note(const std::shared_ptr<const Frame>& frame, const FramePose* pose,
                    std::optional<KeyframeId> keyframe, const DriveState& drive) = 0;
  /// The map `before` has given way to `now`: see Successor.
  virtual void CarryOver(const Map& before, const Map& now) = 0;
};

/// The policy of SlamOptions::base. Camera and options are copied.
std::unique_ptr<TrackingPolicy> MakeTrackingPolicy(const StereoCamera& camera,
                                                   const SlamOptions& options);

}  // namespace aisle::slam
