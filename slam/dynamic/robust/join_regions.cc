#include "slam/dynamic/robust/join_regions.h"

#include <cmath>

namespace aisle::slam::dynamic {
namespace {

/// Mean disparity of each region's known pixels; not a number, which is like none, where none is
/// known.
std::vector<float> MeanDisparities(const PixelRegions& regions, const cv::Mat1f& disparity) {
  std::vector<double> sums(regions.regions.size(), 0.0), counts(regions.regions.size(), 0.0);
  for (int y = 0; y < disparity.rows; ++y) {
    const int* label = regions.labels[y];
    const float* known = disparity[y];
    for (int x = 0; x < disparity.cols; ++x) {
      if (label[x] <= 0 || known[x] <= 0) continue;
      const auto region = static_cast<std::size_t>(label[x] - 1);
      sums[region] += known[x];
      ++counts[region];
    }
  }
  std::vector<float> means(sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k) means[k] = static_cast<float>(sums[k] / counts[k]);
  return means;
}

PixelRegion United(const PixelRegion& a, const PixelRegion& b) {
  const int pixels = a.pixels + b.pixels;
  return {std::min(a.id, b.id), a.box | b.box, pixels,
          (a.log_odds * a.pixels + b.log_odds * b.pixels) / pixels};
}

}  // namespace

std::vector<PixelRegion> JoinRegions(const PixelRegions& parts, const cv::Mat1f& disparity,
                                     const DisparityTolerance& tolerance,
                                     const RegionOptions& options) {
  const std::vector<float> distance = MeanDisparities(parts, disparity);
  std::vector<PixelRegion> whole;
  std::vector<std::size_t> largest;  // part of each whole
  const auto is_part_of = [&](std::size_t part, std::size_t other) {
    const cv::Rect &box = parts.regions[part].box, &around = parts.regions[other].box;
    return (box & around).area() >= options.overlap * box.area() &&
           tolerance.Same(distance[other], distance[part]);
  };
  for (std::size_t part = 0; part < parts.regions.size(); ++part) {
    const auto of = std::find_if(largest.begin(), largest.end(),
                                 [&](std::size_t other) { return is_part_of(part, other); });
    if (of == largest.end()) {
      whole.push_back(parts.regions[part]);
      largest.push_back(part);
      continue;
    }
    PixelRegion& joined = whole[static_cast<std::size_t>(of - largest.begin())];
    joined = United(joined, parts.regions[part]);
  }
  return whole;
}

}  // namespace aisle::slam::dynamic
