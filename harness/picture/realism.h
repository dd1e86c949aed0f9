#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

namespace aisle {

/// One statistic of pictures by which a camera's contrast is told.
struct PictureStatistic {
  const char* key;         ///< in JSON
  const char* name;        ///< in tables
  const char* definition;  ///< a sentence
  int digits;              ///< after the point, in tables
};

/// In the order in which Describe gives their values.
std::span<const PictureStatistic> PictureStatistics();

/// The values of one picture; the last, temporal noise, of it and the next, NaN where `next` is
/// empty or of another size, or where TemporalNoise has none: the camera moved, or too few pixels
/// are plain. The slopes of a picture smaller than a tile (PowerSpectrum) are NaN too.
std::vector<double> DescribePicture(const cv::Mat1b& image, const cv::Mat1b& next);

/// The median of each statistic over the pictures for which it is a number; NaN where none is.
std::vector<double> MedianOfEach(const std::vector<std::vector<double>>& pictures);

}  // namespace aisle
