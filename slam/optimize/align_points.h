#pragma once

#include <optional>

#include "slam/common/option_fields.h"
#include "slam/optimize/refine_pose.h"

namespace aisle::slam {

struct AlignPointsOptions {
  int hypotheses = 300;  ///< at most; fewer once a good one is as likely as `confidence`
  double confidence = 0.999;
  double chi2_slack = 4;   ///< a hypothesis' inliers may exceed their chi-square bound by this
  int least_inliers = 15;  ///< after refinement; fewer: no pose
  std::uint64_t seed = 1;  ///< of the samples drawn
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, AlignPointsOptions& options);

/// The pose from point correspondences of which many may be wrong, without a first guess, by RANSAC
/// (Fischler and Bolles 1981): three stereo points and their landmarks make a hypothesis (Horn
/// 1987, the closed form on the two triangles), the one that most observations support is refined.
/// Defined for any motion, none included. The same observations and seed give the same pose.
std::optional<RefinedPose> AlignPoints(const StereoCamera& camera,
                                       const std::vector<PointObservation>& observations,
                                       const AlignPointsOptions& options);

}  // namespace aisle::slam
