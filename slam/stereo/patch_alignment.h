#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "slam/stereo/stereo_options.h"

namespace aisle::slam {

/// Where a patch of the left level reappears in the same row of the right level.
struct RowAlignment {
  double column = 0;    ///< pixels of the level, sub-pixel
  double sigma = 0;     ///< pixels of the level: deviation by image noise alone
  double mismatch = 0;  ///< mean absolute difference of the two patches, grey levels
};

/// Slides the square around `left_pixel` over whole columns around `right_column` (least sum of
/// absolute differences, each patch less its mean), then refines by least squares (Lucas and Kanade
/// 1981 along the row, with the surface's slant and a difference in brightness as free numbers).
/// Nothing where the best column is at the end of the search, the patch has no gradient along the
/// row, or a patch would leave its image.
std::optional<RowAlignment> AlignAlongRow(const cv::Mat1b& left, cv::Point2d left_pixel,
                                          const cv::Mat1b& right, double right_column,
                                          const StereoOptions& options);

}  // namespace aisle::slam
