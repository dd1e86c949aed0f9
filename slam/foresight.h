#pragma once

#include "slam/dynamic/dynamic_detector.h"
#include "slam/map/map.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Where motion predicts the rig to have gone since the last frame: T_now_before. Nothing where no
/// motion is known or the gap is longer than it can be trusted for.
std::optional<Eigen::Isometry3d> ForeseeMotion(const TrackMemory& memory, std::int64_t stamp_ns,
                                               const TrackOptions& options);

/// The landmarks that took part in the last frame's pose, as seen from that frame, with the time
/// since a keyframe first saw them: what has stood still for long is likely to go on so.
std::vector<KnownPoint> RecallPoints(const Map& map, const TrackMemory& memory);

}  // namespace aisle::slam
