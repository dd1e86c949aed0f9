#include "slam/feature/feature_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace aisle::slam {
namespace {

TEST(FeatureGrid, FindsWhatLookingAtEveryKeypointFinds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> u(0, 751), v(0, 479), radius(1, 60);
  std::vector<Keypoint> keypoints(800);
  for (Keypoint& keypoint : keypoints) {
    keypoint.pixel = {u(random), v(random)};
    keypoint.level = static_cast<int>(random() % 8);
  }
  const FeatureGrid grid(keypoints, {752, 480});
  for (int query = 0; query < 100; ++query) {
    const cv::Point2f center(u(random) * 1.2f - 60, v(random) * 1.2f - 60);
    const float reach = radius(random);
    std::vector<int> expected;
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      const cv::Point2f d = keypoints[i].pixel - center;
      const bool near = std::abs(d.x) <= reach && std::abs(d.y) <= reach;
      if (near && keypoints[i].level >= 2 && keypoints[i].level <= 4) {
        expected.push_back(static_cast<int>(i));
      }
    }
    std::vector<int> found = grid.Near(center, reach, 2, 4);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(FeatureGrid, ASearchWiderThanIntegersCountFindsAll) {
  std::vector<Keypoint> keypoints(3);
  keypoints[1].pixel = {300, 200};
  keypoints[2].pixel = {600, 400};
  EXPECT_EQ(FeatureGrid(keypoints, {752, 480}).Near({300, 200}, 1e12F, 0, 7).size(), 3u);
}

TEST(FeatureGrid, AnEmptyGridHoldsNothing) {
  EXPECT_TRUE(FeatureGrid().Near({0, 0}, 1000, 0, 7).empty());
  EXPECT_TRUE(FeatureGrid({}, {752, 480}).Near({0, 0}, 1000, 0, 7).empty());
}

}  // namespace
}  // namespace aisle::slam
