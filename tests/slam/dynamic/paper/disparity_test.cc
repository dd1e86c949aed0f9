#include "slam/dynamic/paper/disparity.h"

#include <gtest/gtest.h>

#include "tests/slam/dynamic/synthetic_stereo.h"
#include "tests/slam/stereo/dense/disparity_agreement.h"

namespace aisle::slam::dynamic {
namespace {

TEST(Disparity, AgreesWithTheTruthOfATexturedHall) {
  const auto view =
      test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0);
  const test::Agreement agreement =
      test::Compare(ComputeDisparity(view.left, view.right, {}), view.disparity);
  EXPECT_GT(agreement.known, 0.85);
  // The floor is slanted and blurred: it is where SGBM rounds most.
  EXPECT_GT(agreement.close, 0.8);
}

TEST(Disparity, NeverPointsBeyondTheRightImage) {
  const auto view =
      test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0);
  const cv::Mat1f disparity = ComputeDisparity(view.left, view.right, {});
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < disparity.cols; ++x) ASSERT_LE(disparity(y, x), static_cast<float>(x));
  }
}

TEST(Disparity, OfHalfTheSizeAgreesAlmostAsOften) {
  const auto view =
      test::Render(test::StaticHall(), StereoCamera{}, Eigen::Isometry3d::Identity(), 0);
  DisparityOptions half;
  half.half_size = true;
  const cv::Mat1f disparity = ComputeDisparity(view.left, view.right, half);
  ASSERT_EQ(disparity.size(), view.left.size());
  const test::Agreement agreement = test::Compare(disparity, view.disparity);
  EXPECT_GT(agreement.known, 0.85);
  EXPECT_GT(agreement.close, 0.75);
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
  cv::setNumThreads(1);
  const cv::Mat1f one = ComputeDisparity(view.left, view.right, {});
  cv::setNumThreads(4);
  const cv::Mat1f four = ComputeDisparity(view.left, view.right, {});
  cv::setNumThreads(threads);
  EXPECT_EQ(cv::norm(one, four, cv::NORM_INF), 0);
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
