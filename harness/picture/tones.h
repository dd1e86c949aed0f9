#pragma once

#include <opencv2/core.hpp>

namespace aisle {

/// Grey up to which a pixel is black, and from which it is white.
inline constexpr int kBlack = 5, kWhite = 250;

/// Share of pixels that are black, in [0, 1].
double BlackShare(const cv::Mat1b& image);
/// Share of pixels that are white, in [0, 1].
double WhiteShare(const cv::Mat1b& image);
/// The grey that a share q of the pixels stay at or below.
double GreyQuantile(const cv::Mat1b& image, double q);

}  // namespace aisle
