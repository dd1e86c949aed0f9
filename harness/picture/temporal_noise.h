#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace aisle {

/// Temporal noise at grey 100, grey levels, from two pictures one after the other: the deviation of
/// their difference over √2, on plain pixels (gradient of the mean below 1) of mean grey 90 to 110.
/// The difference's mean is taken off: lamps flicker. Nothing where the camera moved between them
/// (textured pixels, of gradient above 5, differ by more than 4 levels in the median) or fewer than
/// 200 pixels are plain.
std::optional<double> TemporalNoise(const cv::Mat1b& first, const cv::Mat1b& second);

}  // namespace aisle
