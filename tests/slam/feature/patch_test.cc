#include "slam/feature/patch.h"

#include <gtest/gtest.h>

#include "tests/slam/stereo/synthetic_view.h"

namespace aisle::slam {
namespace {

TEST(CutPatches, ShowWhatLiesAroundEachCornerAtItsLevel) {
  const ImageFeatures image = ExtractFeatures(Render({752, 480}, Texture(3)), {}, {});
  const std::vector<FeaturePatch> patches = CutPatches(image);
  ASSERT_EQ(patches.size(), image.features.keypoints.size());
  int upper_levels = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Keypoint& keypoint = image.features.keypoints[i];
    const cv::Mat1b& level = image.pyramid.levels[static_cast<std::size_t>(keypoint.level)];
    const cv::Point2d at = image.pyramid.ToLevel(keypoint.pixel, keypoint.level);
    const cv::Point corner(cvRound(at.x), cvRound(at.y));
    constexpr int kReach = FeaturePatch::kReach;
    for (const cv::Point off : {cv::Point(0, 0), cv::Point(-kReach, -kReach),
                                cv::Point(kReach, kReach), cv::Point(3, -5)}) {
      ASSERT_EQ(patches[i].At(off.x, off.y), level(corner + off)) << i;
    }
    upper_levels += keypoint.level > 0;
  }
  EXPECT_GT(upper_levels, 100);
}

}  // namespace
}  // namespace aisle::slam
