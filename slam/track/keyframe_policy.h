#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Whether a tracked frame should join the map: it sees clearly less of the map than its reference
/// keyframe does, or many close points that are not in the map, and the rig has moved.
bool NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                   const StereoCamera& camera, const KeyframeOptions& options);

}  // namespace aisle::slam
