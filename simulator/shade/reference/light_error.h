#pragma once

#include <array>
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

/// How the change of one picture's light from a frame to the next is that of another's; in shares
/// of white.
struct LightChange {
  int pixels = 0;                          ///< compared
  double rms_ours = 0, rms_reference = 0;  ///< of the changes
  double rms_between = 0;                  ///< of ours less the reference's
  double rms_noise = 0;                    ///< of the reference's own noise, part of rms_between
  double correlation = 0;                  ///< of the changes
};

/// Compares changes where `where` is not 0. The reference's is the mean of two halves of which each
/// has its own noise.
LightChange CompareChange(const cv::Mat1f& ours, const std::array<cv::Mat1f, 2>& halves,
                          const cv::Mat1b& where);

}  // namespace aisle::sim
