#include "slam/feature/pyramid.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "slam/common/standalone.h"

namespace aisle::slam {

cv::Point2d Pyramid::ToFull(cv::Point2d pixel, int level) const {
  const cv::Point2d step = steps[static_cast<std::size_t>(level)];
  return {(pixel.x + 0.5) * step.x - 0.5, (pixel.y + 0.5) * step.y - 0.5};
}

cv::Point2d Pyramid::ToLevel(cv::Point2d pixel, int level) const {
  const cv::Point2d step = steps[static_cast<std::size_t>(level)];
  return {(pixel.x + 0.5) / step.x - 0.5, (pixel.y + 0.5) / step.y - 0.5};
}

Pyramid BuildPyramid(const cv::Mat1b& image, const FeatureOptions& options) {
  Pyramid pyramid;
  double scale = 1.0;
  for (int level = 0; level < options.levels; ++level, scale *= options.scale) {
    const cv::Size size(static_cast<int>(std::lround(image.cols / scale)),
                        static_cast<int>(std::lround(image.rows / scale)));
    if (std::min(size.width, size.height) <= 2 * options.border_px) break;
    cv::Mat1b resized = level == 0 ? Standalone(image) : cv::Mat1b();
    if (level > 0) cv::resize(pyramid.levels.back(), resized, size, 0, 0, cv::INTER_LINEAR);
    pyramid.levels.push_back(resized);
    pyramid.scales.push_back(scale);
    pyramid.steps.emplace_back(static_cast<double>(image.cols) / size.width,
                               static_cast<double>(image.rows) / size.height);
  }
  return pyramid;
}

}  // namespace aisle::slam
