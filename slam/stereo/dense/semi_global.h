#pragma once

#include <opencv2/core.hpp>

#include "slam/stereo/dense/disparity_image.h"
#include "slam/stereo/dense/semi_global_options.h"

namespace aisle::slam {

/// A match so close to the right image's edge has looked at padding: its costs reach three pixels
/// (a 5x5 census summed over 3x3), and the fraction of a disparity is told by one more on each
/// side.
inline constexpr int kMatchReach = 4;

/// Disparity of every left pixel in pixels (x_left - x_right >= 0, in sixteenths), kNoDisparity
/// where unknown, by semi-global matching (Hirschmueller 2008) of census costs along rows and
/// columns, both ways. Same size as the images, which must be equal in size and not empty. Whole
/// numbers alone, each pixel by itself or along its own path: the same bits for any number of
/// threads and on any machine.
cv::Mat1f MatchSemiGlobally(const cv::Mat1b& left, const cv::Mat1b& right,
                            const SemiGlobalOptions& options);

}  // namespace aisle::slam
