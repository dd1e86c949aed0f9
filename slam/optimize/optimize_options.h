#pragma once

#include <cstdint>

#include "slam/common/option_fields.h"

namespace aisle::slam {

/// A pose from points of which many may be wrong, see AlignPoints.
struct AlignPointsOptions {
  int hypotheses = 300;  ///< at most; fewer once a good one is as likely as `confidence`
  double confidence = 0.999;
  double chi2_slack = 4;   ///< a hypothesis' inliers may exceed their chi-square bound by this
  int least_inliers = 15;  ///< after refinement; fewer: no pose
  std::uint64_t seed = 1;  ///< of the samples drawn
};

/// The adjustment of the surroundings of a keyframe.
struct LocalAdjustmentOptions {
  int free_keyframes = 12;    ///< the keyframe and its most covisible ones
  int fixed_keyframes = 20;   ///< others that see the same landmarks, most shared first
  int least_shared = 15;      ///< landmarks; fewer make no neighbours
  int robust_iterations = 4;  ///< first pass
  int final_iterations = 6;   ///< second pass, without outliers; 0: there is none
  bool second_chance = true;  ///< an outlier of the first pass may pass the last test
};

/// The adjustment of the whole map.
struct GlobalAdjustmentOptions {
  int robust_iterations = 8;  ///< first pass
  int final_iterations = 8;   ///< second pass, without outliers
};

/// How the error of loops is shared out. What one keyframe tells of another's pose deviates by so
/// much, neighbours and loops alike: a loop counts for no more than the drift that it corrects.
struct LoopSpreadOptions {
  double sigma_m = 0.02;     ///< translation
  double sigma_rad = 0.005;  ///< rotation
  int strong_shared = 100;   ///< landmarks from which on two keyframes are held together directly
  int iterations = 30;
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, AlignPointsOptions& options);
void Describe(OptionFields& fields, LocalAdjustmentOptions& options);
void Describe(OptionFields& fields, GlobalAdjustmentOptions& options);
void Describe(OptionFields& fields, LoopSpreadOptions& options);

}  // namespace aisle::slam
