#pragma once

#include <opencv2/core.hpp>

namespace aisle::slam::dynamic {

/// A rectified stereo pair, 8-bit grey, both images of one size.
struct StereoPair {
  cv::Mat1b left, right;
};

/// What a disparity image holds where nothing could be matched.
inline constexpr float kNoDisparity = -1.0F;

}  // namespace aisle::slam::dynamic
