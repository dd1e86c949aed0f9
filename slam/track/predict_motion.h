#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Where the rig's velocity carries it from the last frame to `stamp_ns`. Nothing where that is not
/// known or the gap is longer than it can be trusted for.
std::optional<MeasuredMotion> PredictMotion(const TrackMemory& memory, std::int64_t stamp_ns,
                                            const TrackOptions& options);

/// Where the rig would be now if it had kept its motion, for longest_gap_s at most: T_world_rig.
/// The world's origin while there is no map.
Eigen::Isometry3d ReckonedPose(const Map& map, const TrackMemory& memory, std::int64_t stamp_ns,
                               const TrackOptions& options);

}  // namespace aisle::slam
