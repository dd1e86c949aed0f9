#include "slam/dynamic/spread_features.h"

#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>

#include "slam/dynamic/counter_random.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

cv::Mat1b HallImage() {
  return test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0).left;
}

std::vector<Corner> RandomCorners(int count, cv::Size image) {
  CounterRandom random(5, 0);
  std::vector<Corner> corners;
  for (int k = 0; k < count; ++k) {
    const auto x = static_cast<float>(random.Below(image.width));
    const auto y = static_cast<float>(random.Below(image.height));
    corners.push_back({{x, y}, static_cast<float>(random.Below(200))});
  }
  return corners;
}

TEST(DetectInCells, FindsWhatFastFindsOnTheWholeImageWhereTheThresholdIsTheSame) {
  const cv::Mat1b image = HallImage();
  SpreadOptions options;
  options.fast_threshold_low = options.fast_threshold;
  std::vector<cv::KeyPoint> whole;
  cv::FAST(image, whole, options.fast_threshold, true);
  std::set<std::pair<float, float>> expected;
  const cv::Rect inner(options.border_px, options.border_px, image.cols - 2 * options.border_px,
                       image.rows - 2 * options.border_px);
  for (const auto& point : whole) {
    if (inner.contains(point.pt)) expected.insert({point.pt.x, point.pt.y});
  }
  std::set<std::pair<float, float>> found;
  for (const Corner& corner : DetectInCells(image, options)) {
    found.insert({corner.position.x, corner.position.y});
  }
  // Suppression of neighbours cannot look across the rim of a cell: there, two more may survive.
  for (const auto& corner : expected) EXPECT_TRUE(found.contains(corner));
  EXPECT_LT(static_cast<double>(found.size()), 1.05 * static_cast<double>(expected.size()));
}

TEST(SpreadByQuadtree, ReachesTheCountAndOverfillsByLessThanOneSplit) {
  const cv::Size image(752, 480);
  for (const int count : {50, 333, 800}) {
    const auto kept = SpreadByQuadtree(RandomCorners(4000, image), image, count);
    EXPECT_GE(static_cast<int>(kept.size()), count);
    EXPECT_LE(static_cast<int>(kept.size()), count + 3);
  }
}

TEST(SpreadByQuadtree, KeepsAllWhenThereAreFewerThanAskedFor) {
  const cv::Size image(752, 480);
  auto corners = RandomCorners(40, image);
  corners.push_back(corners.front());  // two at one place can never be told apart
  EXPECT_EQ(SpreadByQuadtree(corners, image, 500).size(), 40U);
  EXPECT_TRUE(SpreadByQuadtree({}, image, 500).empty());
}

TEST(SpreadByQuadtree, IsMoreEvenThanTheStrongestCorners) {
  const cv::Mat1b image = HallImage();
  const auto corners = DetectInCells(image, {});
  const auto spread = SpreadByQuadtree(corners, image.size(), 300);
  auto strongest = corners;
  std::stable_sort(strongest.begin(), strongest.end(),
                   [](const Corner& a, const Corner& b) { return a.response > b.response; });
  strongest.resize(spread.size());
  const auto squares_hit = [](const std::vector<Corner>& some) {
    std::set<std::pair<int, int>> squares;
    for (const Corner& c : some) {
      squares.insert({static_cast<int>(c.position.x) / 40, static_cast<int>(c.position.y) / 40});
    }
    return squares.size();
  };
  EXPECT_GT(squares_hit(spread), squares_hit(strongest) * 5 / 4);
}

TEST(SpreadFeatures, FindsNothingInABlankOrTinyImage) {
  EXPECT_TRUE(SpreadFeatures(cv::Mat1b(480, 752, 90), {}).empty());
  EXPECT_TRUE(SpreadFeatures(cv::Mat1b(10, 10, 90), {}).empty());
}

}  // namespace
}  // namespace aisle::slam::dynamic
