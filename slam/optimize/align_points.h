#pragma once

#include <optional>

#include "slam/optimize/optimize_options.h"
#include "slam/optimize/refine_pose.h"

namespace aisle::slam {

/// The pose from point correspondences of which many may be wrong, without a first guess, by RANSAC
/// (Fischler and Bolles 1981): three stereo points and their landmarks make a hypothesis (Horn
/// 1987, the closed form on the two triangles), the one that most observations support is refined.
/// Defined for any motion, none included. The same observations and seed give the same pose.
std::optional<RefinedPose> AlignPoints(const StereoCamera& camera,
                                       const std::vector<PointObservation>& observations,
                                       const AlignPointsOptions& options);

}  // namespace aisle::slam
