#pragma once

#include <optional>

#include "harness/contract/run.h"

namespace aisle {

/// Depth at every kDepthGridStep-th pixel of every kDepthGridStep-th row: what parallax needs, and
/// small enough to be kept with a stored frame.
inline constexpr int kDepthGridStep = 16;
cv::Mat1f DepthGrid(const cv::Mat1f& depth);

/// How hard a frame is for any system, from truth alone: separates "impossible" from "failed".
/// `T_world_previous` is the rig one frame (`frame_ms`) earlier, absent for the first. Parts that
/// the truth does not tell (no depth, no mask) are absent.
Difficulty DifficultyOf(const cv::Mat1b& left, const FrameTruth& truth,
                        const StereoCalibration& calibration,
                        const std::optional<Eigen::Isometry3d>& T_world_previous, double frame_ms);

}  // namespace aisle
