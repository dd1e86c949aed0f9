#include "slam/dynamic/paper/disparity.h"

#include <gtest/gtest.h>

#include "tests/slam/dynamic/synthetic_stereo.h"
#include "tests/slam/stereo/dense/disparity_agreement.h"

namespace aisle::slam::dynamic {
namespace {

test::Agreement OfTheHall(const DisparityOptions& options) {
  const auto view =
      test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0);
  const cv::Mat1f disparity = ComputeDisparity(view.left, view.right, options);
  EXPECT_EQ(disparity.size(), view.left.size());
  return test::Compare(disparity, view.disparity);
}

TEST(Disparity, AgreesWithTheTruthOfATexturedHall) {
  const test::Agreement agreement = OfTheHall({.half_size = false});
  EXPECT_GT(agreement.known, 0.85);
  // The floor is slanted and blurred: it is where SGBM rounds most.
  EXPECT_GT(agreement.close, 0.8);
}

TEST(Disparity, NeverPointsBeyondTheRightImage) {
  const auto view =
      test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0);
  for (const bool half : {false, true}) {
    const cv::Mat1f disparity = ComputeDisparity(view.left, view.right, {.half_size = half});
    for (int y = 0; y < disparity.rows; ++y) {
      for (int x = 0; x < disparity.cols; ++x) ASSERT_LE(disparity(y, x), static_cast<float>(x));
    }
  }
}

/// Two pictures of one wall, the right one shifted.
int FoundOfAWall(int shift, const DisparityOptions& options) {
  cv::Mat1b wall(120, 400);
  for (int y = 0; y < wall.rows; ++y) {
    for (int x = 0; x < wall.cols; ++x) {
      wall(y, x) =
          cv::saturate_cast<unsigned char>(128 + 100 * test::ValueNoise(x / 5., y / 5., 1));
    }
  }
  const int width = wall.cols - shift;
  const cv::Mat1f disparity = ComputeDisparity(wall.colRange(0, width).clone(),
                                               wall.colRange(shift, wall.cols).clone(), options);
  return cv::countNonZero(cv::abs(disparity - shift) < 2);
}

TEST(Disparity, IsSearchedAsFarAsItIsToBeAndNoFarther) {
  for (const bool half : {false, true}) {
    for (const int most : {16, 48, 96}) {
      const DisparityOptions options{.max_disparity_px = most, .half_size = half};
      EXPECT_GT(FoundOfAWall(most - 4, options), 20'000) << most << (half ? " at half size" : "");
      EXPECT_EQ(FoundOfAWall(most + 8, options), 0) << most << (half ? " at half size" : "");
    }
  }
}

TEST(Disparity, OfHalfTheSizeAgreesAboutAsOften) {
  const test::Agreement whole = OfTheHall({.half_size = false}), half = OfTheHall({});
  EXPECT_GT(half.known, whole.known - 0.05);
  EXPECT_GT(half.close, whole.close - 0.05);
  EXPECT_NE(half.close, whole.close) << "one of them is not of its size";
}

TEST(Disparity, OfHalfTheSizeKeepsOddImagesWhole) {
  const auto view =
      test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0);
  const cv::Rect odd(0, 0, 401, 301);
  DisparityOptions half;
  half.half_size = true;
  const cv::Mat1f disparity = ComputeDisparity(view.left(odd), view.right(odd), half);
  ASSERT_EQ(disparity.size(), odd.size());
  for (int x = 0; x < disparity.cols; ++x) {
    ASSERT_LE(disparity(300, x), static_cast<float>(x));
    ASSERT_EQ(disparity(300, x), disparity(299, x)) << "the last row is its neighbour's";
  }
}

TEST(Disparity, IsTheSameForAnyNumberOfThreads) {
  const auto view =
      test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0);
  const int threads = cv::getNumThreads();
  for (const bool half : {false, true}) {
    cv::setNumThreads(1);
    const cv::Mat1f one = ComputeDisparity(view.left, view.right, {.half_size = half});
    cv::setNumThreads(4);
    const cv::Mat1f four = ComputeDisparity(view.left, view.right, {.half_size = half});
    cv::setNumThreads(threads);
    EXPECT_EQ(cv::norm(one, four, cv::NORM_INF), 0);
  }
}

TEST(DisparityNear, IsTheMedianOfWhatIsKnown) {
  cv::Mat1f disparity(5, 5, kNoDisparity);
  EXPECT_EQ(DisparityNear(disparity, {2, 2}, 2), kNoDisparity);
  disparity(1, 1) = 3;
  disparity(2, 2) = 90;
  disparity(3, 1) = 4;
  EXPECT_EQ(DisparityNear(disparity, {2.2F, 1.9F}, 1), 4);
  EXPECT_EQ(DisparityNear(disparity, {-20, 2}, 2), kNoDisparity);
}

}  // namespace
}  // namespace aisle::slam::dynamic
