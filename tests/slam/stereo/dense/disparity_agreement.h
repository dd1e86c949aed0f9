#pragma once

#include <opencv2/core.hpp>

#include "slam/stereo/dense/disparity_image.h"

// How far a matcher's disparities agree with the truth of a rendered view.

namespace aisle::slam::test {

struct Agreement {
  double known = 0;  // share of the pixels that see something in both images
  double close = 0;  // share of those known that are within one pixel of the truth
};

inline Agreement Compare(const cv::Mat1f& disparity, const cv::Mat1f& truth) {
  int seen = 0, known = 0, close = 0;
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      if (truth(y, x) <= 0 || truth(y, x) > static_cast<float>(x)) continue;
      ++seen;
      if (disparity(y, x) == kNoDisparity) continue;
      ++known;
      if (std::abs(disparity(y, x) - truth(y, x)) < 1.0F) ++close;
    }
  }
  return {1.0 * known / seen, 1.0 * close / known};
}

}  // namespace aisle::slam::test
