#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/disparity_tolerance.h"
#include "slam/dynamic/robust/moving_regions.h"

namespace aisle::slam::dynamic {

/// What is known of the pixels before the current frame has had its say.
struct LabelMemory {
  cv::Mat1f log_odds;  ///< per half-size pixel, without the neighbours' share
  PixelRegions regions;
  /// What the longer gaps have said, each in its turn, faded since; empty if none was compared.
  cv::Mat1f long_log_odds = {};
  cv::Mat2f long_per_step = {};  ///< its residual, shared out among its steps
};

/// Nothing known, nothing moving; the next region is given `next_region_id`.
LabelMemory ForgottenMemory(cv::Size size, int next_region_id);

/// Takes the memory of the previous frame to the current one along the flow, whatever moved; where
/// the previous frame shows another surface at the place, nothing is known (0). At the left border,
/// beyond the right image, where there is no surface to compare, the flow alone is followed.
/// `if_static`: the disparities then, were nothing moving (StaticField). Regions keep their ids and
/// sizes.
LabelMemory CarryMemory(const LabelMemory& previous, const cv::Mat2f& flow,
                        const cv::Mat1f& if_static, const DenseFrame& now, const DenseFrame& before,
                        const DisparityTolerance& tolerance);

}  // namespace aisle::slam::dynamic
