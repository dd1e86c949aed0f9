#pragma once

#include <opencv2/core.hpp>

namespace aisle::sim {

/// How far one picture's light is from another's.
struct LightError {
  double median_relative = 0;  ///< median over pixels of |ours / reference - 1|
  double ssim = 0;             ///< mean structural similarity, 1: equal
  double mean_ratio = 0;       ///< mean of ours / mean of the reference
};

/// Compares two images of linear light, in shares of white; what is brighter counts as white, as in
/// a picture. Structural similarity after Wang et al. 2004: Gaussian windows of sigma 1.5 pixels,
/// K1 = 0.01, K2 = 0.03. Pixels where the reference is below a thousandth of white do not enter the
/// relative error.
LightError CompareLight(const cv::Mat1f& ours, const cv::Mat1f& reference);

}  // namespace aisle::sim
