#pragma once

#include <opencv2/core.hpp>

namespace aisle {

/// Median magnitude of the gradient, grey levels a pixel: Sobel's 3 × 3 differences, each over 8,
/// so that a ramp of slope s has s. The border pixel is left out.
double MedianGradient(const cv::Mat1b& image);

/// Median over 16 × 16 blocks of the deviation over the mean; blocks of mean 0 have none. NaN for a
/// picture that is smaller than a block.
double LocalContrast(const cv::Mat1b& image);

/// Deviation that a tenth of the 8 × 8 blocks stay below, grey levels: noise and grain of plain
/// surfaces. Blocks with a pixel at most 5 or at least 250 are left out: what is clipped has no
/// deviation. NaN where none is left.
double PlainDeviation(const cv::Mat1b& image);

/// Variance of the Laplacian [0 1 0; 1 -4 1; 0 1 0] over the picture without its border pixel.
double LaplacianVariance(const cv::Mat1b& image);

}  // namespace aisle
