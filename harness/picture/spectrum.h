#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace aisle {

/// Power of a picture by frequency: value k holds frequency k / 256 cycles a pixel, the mean over
/// its ring and over 256 × 256 tiles that overlap by half, each without its mean and under a Hann
/// window; 129 values, the first 0. Empty for a picture smaller than a tile.
std::vector<double> PowerSpectrum(const cv::Mat1b& image);

/// Slope of log power over log frequency between two frequencies (cycles a pixel), least squares
/// over the rings. NaN for an empty spectrum.
double SpectrumSlope(const std::vector<double>& spectrum, double from, double to);

}  // namespace aisle
