#include "slam/dynamic/robust/floor_plane.h"

#include <gtest/gtest.h>

#include "slam/dynamic/common/counter_random.h"
#include "tests/slam/dynamic/robust/usual_tolerance.h"

namespace aisle::slam::dynamic {
namespace {

using test::kUsualTolerance;

const StereoCamera kCamera{376, 240, 217.6, 217.6, 183.6, 126.1, 0.12};

/// A floor seen from 1.2 m by a level camera, with noise and a box standing on it.
cv::Mat1f FloorWithBox(const cv::Rect& box) {
  CounterRandom random(7, 0);
  cv::Mat1f disparity(240, 376, 1.0F);
  for (int y = 126; y < 240; ++y) {
    for (int x = 0; x < 376; ++x) {
      const float noise = static_cast<float>(random.Below(1000) - 500) / 2500;
      disparity(y, x) = 0.1F * static_cast<float>(y - 116) + noise;
    }
  }
  const float foot = disparity(std::min(box.br().y, 239), box.x);
  disparity(box).setTo(foot);
  return disparity;
}

TEST(FindFloor, FindsThePlaneUnderABox) {
  const cv::Rect box(150, 60, 120, 150);
  const cv::Mat1f disparity = FloorWithBox(box);
  const auto floor = FindFloor(disparity, kCamera, kUsualTolerance);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->At(50, 200), 8.4, 0.15);
  EXPECT_NEAR(floor->At(330, 150), 3.4, kUsualTolerance.At(3.4F) / 2);
  const cv::Mat1b mask = FloorMask(disparity, floor, kUsualTolerance);
  EXPECT_EQ(mask(220, 50), 255);
  EXPECT_EQ(mask(120, 200), 0);
  EXPECT_EQ(cv::countNonZero(mask(cv::Rect(150, 60, 120, 120))), 0);
}

/// Half a metre ahead, leaning back by eight degrees; it fills the view.
TEST(FindFloor, ABackCloseByIsNone) {
  cv::Mat1f disparity(240, 376);
  for (int y = 0; y < 240; ++y) {
    disparity.row(y).setTo(52.0F + 0.034F * static_cast<float>(y - 126));
  }
  EXPECT_FALSE(FindFloor(disparity, kCamera, kUsualTolerance));
}

/// A third of a metre ahead of a narrow lens, bulging: what is below leans as a floor would, and is
/// hardly nearer than what is above.
TEST(FindFloor, ABellyCloseByIsNone) {
  const StereoCamera narrow{376, 240, 350, 350, 183.6, 126.1, 0.12};
  cv::Mat1f disparity(240, 376);
  for (int y = 0; y < 240; ++y) {
    disparity.row(y).setTo(115.0F + 0.36F * static_cast<float>(std::max(y - 126, 0)));
  }
  EXPECT_FALSE(FindFloor(disparity, narrow, kUsualTolerance));
}

TEST(FindFloor, AWallIsNone) {
  EXPECT_FALSE(FindFloor(cv::Mat1f(240, 376, 6.0F), kCamera, kUsualTolerance));
  EXPECT_FALSE(FindFloor(cv::Mat1f(240, 376, -1.0F), kCamera, kUsualTolerance));
  const cv::Mat1b none = FloorMask(cv::Mat1f(240, 376, 6.0F), std::nullopt, kUsualTolerance);
  EXPECT_EQ(cv::countNonZero(none), 0);
}

}  // namespace
}  // namespace aisle::slam::dynamic
