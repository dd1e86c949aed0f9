#include "slam/dynamic/robust/squared_difference.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/common/counter_random.h"
#include "slam/dynamic/robust/fast_log.h"

namespace aisle::slam::dynamic {
namespace {

cv::Mat1b RandomImage(std::uint64_t stream) {
  CounterRandom random(1, stream);
  cv::Mat1b image(37, 53);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image(y, x) = static_cast<unsigned char>(random.Below(256));
  }
  return image;
}

TEST(SquaredDifference, IsTheMeanSquareOfWhatDiffersFromTheLocalMean) {
  const cv::Mat1b image = RandomImage(1), other = RandomImage(2);
  cv::Mat variance, exact_variance, found;
  RandomImage(3).convertTo(exact_variance, CV_64F, 1, 1);
  exact_variance.convertTo(variance, CV_32F);
  cv::Mat difference, mean, expected;
  cv::subtract(image, other, difference, cv::noArray(), CV_64F);
  cv::blur(difference, mean, {11, 11});
  difference -= mean;
  cv::blur(difference.mul(difference) / exact_variance, expected, {5, 5});
  SquaredDifference(image, other, variance).convertTo(found, CV_64F);
  EXPECT_LT(cv::norm(found / expected - 1, cv::NORM_INF), 1e-4);
}

TEST(SquaredDifference, ABrighterCopyFitsPerfectly) {
  cv::Mat1b image, brighter;
  cv::min(RandomImage(4), 200, image);
  cv::add(image, 40, brighter);
  const cv::Mat1f difference = SquaredDifference(image, brighter, cv::Mat1f(image.size(), 1.0F));
  EXPECT_EQ(cv::countNonZero(difference), 0);
}

TEST(FastLog, IsTheLogarithmToAMillionth) {
  for (float a = 1e-20F; a < 1e20F; a *= 1.37F) {
    EXPECT_NEAR(FastLog(a), std::log(a), 1e-6F * std::max(1.0F, std::abs(std::log(a)))) << a;
  }
  EXPECT_EQ(FastLog(1), 0);
}

}  // namespace
}  // namespace aisle::slam::dynamic
