#pragma once

#include <opencv2/core.hpp>

namespace aisle {

struct CornerDensity {
  double per_megapixel = 0;
  double cells_share = 0;  ///< of the whole 32 × 32 cells, those with a corner
};

/// FAST corners (9 of 16, threshold 20 grey levels, non-maxima suppressed; OpenCV's).
CornerDensity CountCorners(const cv::Mat1b& image);

}  // namespace aisle
