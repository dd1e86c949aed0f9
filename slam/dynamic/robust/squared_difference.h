#pragma once

#include <opencv2/core.hpp>

namespace aisle::slam::dynamic {

/// Mean squared difference of two images in units of its variance, over windows of 5x5 pixels and
/// without the local mean (11x11): exposure and soft shadows drop out. Windows are reflected at the
/// image's border.
cv::Mat1f SquaredDifference(const cv::Mat1b& image, const cv::Mat1b& other,
                            const cv::Mat1f& variance);

}  // namespace aisle::slam::dynamic
