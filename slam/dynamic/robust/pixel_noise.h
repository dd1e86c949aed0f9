#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace aisle::slam::dynamic {

/// Variances by grey value, in squared grey levels.
using GreyVariance = std::array<float, 256>;

/// What the sensor's noise gives each pixel of half size, measured on one image of full size: the
/// mean of 2x2 pixels has the noise of their diagonal difference, likewise weighted, which sees
/// next to nothing of the scene. That is the finest band of wavelets, in which Donoho and Johnstone
/// (1994) take noise from the median magnitude; of texture the lower quartile has less. Greys of
/// which there are few have the noise of the nearest ones of which there are enough.
GreyVariance MeasurePixelNoise(const cv::Mat1b& image);

/// Each pixel's difference from the mean of the 5x5 around is kept by the share of their variance
/// that is not noise (Lee 1980): what the image shows stays, and of grain alone the mean is left.
cv::Mat1b WithoutNoise(const cv::Mat1b& image, const GreyVariance& noise);

}  // namespace aisle::slam::dynamic
