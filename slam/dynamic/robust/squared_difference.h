#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {

/// By how much two images of one static surface differ: variances, in squared grey levels.
struct DifferenceNoise {
  cv::Mat1f fine;    ///< of each pixel beside those around
  cv::Mat1f coarse;  ///< of the mean of those around, which glare changes besides
};
DifferenceNoise ExpectDifferences(const cv::Mat1b& image, const SurfaceOptions& options);

/// Mean squared difference of two images in units of its variance, over windows of 5x5 pixels: of
/// each pixel from the mean around it (5x5), and of that mean from the one farther around (11x11),
/// so that exposure drops out. Windows are reflected at the image's border.
cv::Mat1f SquaredDifference(const cv::Mat1b& image, const cv::Mat1b& other,
                            const DifferenceNoise& noise);

}  // namespace aisle::slam::dynamic
