#include "slam/feature/extract.h"

#include <cmath>
#include <numeric>

#include "slam/feature/corners.h"
#include "slam/feature/describe.h"
#include "slam/feature/mask_margin.h"
#include "slam/feature/quadtree.h"

namespace aisle::slam {
namespace {

void DropMasked(const Pyramid& pyramid, int level, const MaskedArea& masked,
                std::vector<Corner>& corners) {
  if (masked.empty()) return;
  std::erase_if(corners, [&](const Corner& corner) {
    return masked.Contains(pyramid.ToFull(cv::Point2d(corner.x, corner.y), level), level);
  });
}

void AppendLevel(const Pyramid& pyramid, int level, const std::vector<Corner>& corners,
                 Features& features) {
  const cv::Mat1b& image = pyramid.levels[static_cast<std::size_t>(level)];
  std::vector<OrientedPixel> pixels;
  for (const Corner& corner : corners) {
    const cv::Point pixel(corner.x, corner.y);
    pixels.push_back({pixel, OrientationDeg(image, pixel)});
    features.keypoints.push_back(
        {pyramid.ToFull(pixel, level), level, pixels.back().angle_deg, corner.response});
  }
  const std::vector<Descriptor> descriptors = DescribePixels(image, pixels);
  features.descriptors.insert(features.descriptors.end(), descriptors.begin(), descriptors.end());
}

}  // namespace

std::vector<int> ShareBudget(const std::vector<int>& available, int budget, double scale) {
  std::vector<int> share(available.size(), 0);
  int left = std::min(budget, std::accumulate(available.begin(), available.end(), 0));
  while (left > 0) {
    double weights = 0;
    for (std::size_t l = 0; l < share.size(); ++l) {
      if (share[l] < available[l]) weights += std::pow(scale, -static_cast<double>(l));
    }
    const int round = left;
    for (std::size_t l = 0; l < share.size() && left > 0; ++l) {
      if (share[l] == available[l]) continue;
      const double part = round * std::pow(scale, -static_cast<double>(l)) / weights;
      const int given =
          std::min({available[l] - share[l], left, std::max(1, static_cast<int>(part))});
      share[l] += given;
      left -= given;
    }
  }
  return share;
}

ImageCorners FindCorners(const cv::Mat1b& image, const FeatureOptions& options) {
  ImageCorners corners{BuildPyramid(image, options), {}};
  for (const cv::Mat1b& level : corners.pyramid.levels) {
    corners.levels.push_back(DetectCorners(level, options));
  }
  return corners;
}

ImageFeatures ChooseFeatures(ImageCorners corners, const cv::Mat1b& mask,
                             const FeatureOptions& options) {
  ImageFeatures image{std::move(corners.pyramid), {}};
  const MaskedArea masked(mask, options);
  std::vector<int> available;
  for (int level = 0; level < image.pyramid.size(); ++level) {
    std::vector<Corner>& of_level = corners.levels[static_cast<std::size_t>(level)];
    DropMasked(image.pyramid, level, masked, of_level);
    available.push_back(static_cast<int>(of_level.size()));
  }
  const std::vector<int> share = ShareBudget(available, options.features, options.scale);
  for (int level = 0; level < image.pyramid.size(); ++level) {
    const auto l = static_cast<std::size_t>(level);
    AppendLevel(image.pyramid, level, DistributeCorners(corners.levels[l], share[l]),
                image.features);
  }
  return image;
}

ImageFeatures ExtractFeatures(const cv::Mat1b& image, const cv::Mat1b& mask,
                              const FeatureOptions& options) {
  return ChooseFeatures(FindCorners(image, options), mask, options);
}

}  // namespace aisle::slam
