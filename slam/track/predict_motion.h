#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Where motion predicts the rig to have gone since the last frame: T_now_before. Nothing where no
/// motion is known or the gap is longer than it can be trusted for.
std::optional<Eigen::Isometry3d> PredictMotion(const TrackMemory& memory, std::int64_t stamp_ns,
                                               const TrackOptions& options);

}  // namespace aisle::slam
