#include "slam/feature/patch.h"

#include <algorithm>
#include <cmath>

namespace aisle::slam {

std::vector<FeaturePatch> CutPatches(const ImageFeatures& image) {
  constexpr int kReach = FeaturePatch::kReach, kSide = FeaturePatch::kSide;
  std::vector<FeaturePatch> patches;
  patches.reserve(image.features.keypoints.size());
  for (const Keypoint& keypoint : image.features.keypoints) {
    const cv::Mat1b& level = image.pyramid.levels[static_cast<std::size_t>(keypoint.level)];
    const cv::Point2d corner = image.pyramid.ToLevel(keypoint.pixel, keypoint.level);
    // Corners keep FeatureOptions::border_px from the image's edge, which is more than kReach.
    const auto left = static_cast<int>(std::lround(corner.x)) - kReach;
    const auto top = static_cast<int>(std::lround(corner.y)) - kReach;
    FeaturePatch& patch = patches.emplace_back();
    for (int y = 0; y < kSide; ++y) {
      std::copy_n(level.ptr(top + y) + left, kSide, patch.grey.begin() + y * kSide);
    }
  }
  return patches;
}

}  // namespace aisle::slam
