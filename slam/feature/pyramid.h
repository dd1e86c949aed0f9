#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/feature/feature_options.h"

namespace aisle::slam {

/// An image at falling resolutions. Pixel x of level l shows what full-image pixel
/// ToFull(x, l) shows: centres map to centres, so no half-pixel is lost between levels.
struct Pyramid {
  std::vector<cv::Mat1b> levels;  ///< levels[0] is the image itself, a copy if part of a larger one
  std::vector<double> scales;     ///< full-image pixels per pixel of the level, nominal: scale^l
  std::vector<cv::Point2d> steps;  ///< the same as rounded sizes have it, along x and y

  int size() const { return static_cast<int>(levels.size()); }
  cv::Point2d ToFull(cv::Point2d pixel, int level) const;
  cv::Point2d ToLevel(cv::Point2d pixel, int level) const;
};

/// Each level is resized (bilinear) from the one before. Levels end where the
/// border of the options would leave no pixel.
Pyramid BuildPyramid(const cv::Mat1b& image, const FeatureOptions& options);

}  // namespace aisle::slam
