#pragma once

#include <opencv2/core.hpp>

namespace aisle::slam {

/// The image itself; a copy where it is part of a larger one, as of two cameras side by side:
/// OpenCV's filters see what lies around a part.
inline cv::Mat1b Standalone(const cv::Mat1b& image) {
  return image.isSubmatrix() ? image.clone() : image;
}

}  // namespace aisle::slam
