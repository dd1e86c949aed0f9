#include "slam/dynamic/paper/spread_features.h"

#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>

#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

cv::Mat1b HallImage() {
  return test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0).left;
}

std::size_t SquaresHit(const std::vector<cv::Point2f>& points) {
  std::set<std::pair<int, int>> squares;
  for (const cv::Point2f& p : points) {
    squares.insert({static_cast<int>(p.x) / 40, static_cast<int>(p.y) / 40});
  }
  return squares.size();
}

TEST(SpreadFeatures, AreMoreEvenThanTheStrongestCorners) {
  const cv::Mat1b image = HallImage();
  SpreadOptions options;
  options.points = 300;
  const auto spread = SpreadFeatures(image, options);
  ASSERT_EQ(spread.size(), 300U);
  std::vector<cv::KeyPoint> corners;
  cv::FAST(image, corners, options.fast_threshold, true);
  cv::KeyPointsFilter::retainBest(corners, options.points);
  std::vector<cv::Point2f> strongest;
  cv::KeyPoint::convert(corners, strongest);
  EXPECT_GT(SquaresHit(spread), SquaresHit(strongest) * 5 / 4);
}

TEST(SpreadFeatures, StayWithinTheBorder) {
  SpreadOptions options;
  options.border_px = 30;
  for (const cv::Point2f& p : SpreadFeatures(HallImage(), options)) {
    EXPECT_TRUE(cv::Rect2f(30, 30, 752 - 60, 480 - 60).contains(p));
  }
}

TEST(SpreadFeatures, FindNothingInABlankOrTinyImage) {
  EXPECT_TRUE(SpreadFeatures(cv::Mat1b(480, 752, 90), {}).empty());
  EXPECT_TRUE(SpreadFeatures(cv::Mat1b(10, 10, 90), {}).empty());
}

}  // namespace
}  // namespace aisle::slam::dynamic
