#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Whether a tracked frame sees so little of the map, and so much that is not in it, that the next
/// one might see nothing of it. The rig need not have moved where most of what its reference
/// keyframe saw is out of sight: somebody has walked on and shows what he had hidden.
bool NeedsKeyframeAtOnce(const Map& map, const Frame& frame, const FramePose& pose,
                         const StereoCamera& camera, const KeyframeOptions& options);

/// Whether a tracked frame should join the map: at once, or because the rig has moved and sees
/// clearly less of the map than its reference keyframe does, or many close points not in the map.
bool NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                   const StereoCamera& camera, const KeyframeOptions& options);

}  // namespace aisle::slam
