#pragma once

#include <opencv2/core.hpp>

#include "slam/stereo/dense/disparity_image.h"

namespace aisle::slam::dynamic {

/// A rectified stereo pair, 8-bit grey, both images of one size.
struct StereoPair {
  cv::Mat1b left, right;
};

}  // namespace aisle::slam::dynamic
