#pragma once

#include <memory>
#include <optional>

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/options/slam_options.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// The first keyframe of a part of the map.
struct NewPart {
  MapEdit edit;
  bool anew = false;  ///< the world begins with it: what map there was is given up
};

/// Begins a part of the map with a frame, where the rig would be if it had kept its motion for a
/// while; the first part begins in the world's origin. A map of a few keyframes that was lost so
/// soon is not worth keeping: the world begins anew. Nothing where the frame shows too little
/// depth.
std::optional<NewPart> BeginPart(const Map& map, const std::shared_ptr<const Frame>& frame,
                                 const TrackMemory& memory, const StereoCamera& camera,
                                 const SlamOptions& options);

/// The pose of the frame that keyframe `id` was made of, with all its landmarks taking part.
FramePose PoseOfKeyframe(const Map& map, KeyframeId id);

/// The keyframe as a tracked frame asks for it: landmarks that took part in the pose are seen by
/// it, and depth makes new ones.
MapEdit KeyframeFrom(const Map& map, const std::shared_ptr<const Frame>& frame,
                     const FramePose& pose, const StereoCamera& camera,
                     const CreateLandmarksOptions& options);

/// Whether keyframe `id`, present or former, is of the first part of the map (that of a map file,
/// if there is one): that part is where the world is.
bool IsInFirstPart(const Map& map, KeyframeId id);

}  // namespace aisle::slam
