#include "slam/dynamic/robust/squared_difference.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/common/counter_random.h"
#include "slam/dynamic/robust/dense_frame.h"
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

TEST(SquaredDifference, IsTheMeanSquareOfWhatDiffersFromTheMeanAroundAndOfThatMean) {
  const cv::Mat1b image = RandomImage(1), other = RandomImage(2);
  cv::Mat of_fine, of_coarse, found;
  RandomImage(3).convertTo(of_fine, CV_64F, 1, 1);
  RandomImage(5).convertTo(of_coarse, CV_64F, 1, 1);
  DifferenceNoise noise;
  of_fine.convertTo(noise.fine, CV_32F);
  of_coarse.convertTo(noise.coarse, CV_32F);
  cv::Mat difference, around, far_around, expected;
  cv::subtract(image, other, difference, cv::noArray(), CV_64F);
  cv::blur(difference, around, {5, 5});
  cv::blur(difference, far_around, {11, 11});
  const cv::Mat fine = difference - around, coarse = around - far_around;
  cv::blur(fine.mul(fine) / of_fine + coarse.mul(coarse) / of_coarse, expected, {5, 5});
  SquaredDifference(image, other, noise).convertTo(found, CV_64F);
  EXPECT_LT(cv::norm(found / expected - 1, cv::NORM_INF), 1e-4);
}

TEST(SquaredDifference, ABrighterCopyFitsPerfectly) {
  cv::Mat1b image, brighter;
  cv::min(RandomImage(4), 200, image);
  cv::add(image, 40, brighter);
  const cv::Mat1f difference =
      SquaredDifference(image, brighter, ExpectDifferences(image, SurfaceOptions()));
  EXPECT_EQ(cv::countNonZero(difference), 0);
}

TEST(ExpectDifferences, TheMeanAroundChangesByAShareOfItsBrightnessBesides) {
  const cv::Mat1b image = RandomImage(6);
  SurfaceOptions options;
  options.shading_noise = 0.25;
  const DifferenceNoise noise = ExpectDifferences(image, options);
  EXPECT_EQ(cv::norm(noise.fine, DifferenceVariance(image, options), cv::NORM_INF), 0);
  const cv::Point somewhere(17, 11);
  const double shading = 0.25 * image(somewhere);
  EXPECT_NEAR(noise.coarse(somewhere) - noise.fine(somewhere), shading * shading, 1e-2);
}

TEST(FastLog, IsTheLogarithmToAMillionth) {
  for (float a = 1e-20F; a < 1e20F; a *= 1.37F) {
    EXPECT_NEAR(FastLog(a), std::log(a), 1e-6F * std::max(1.0F, std::abs(std::log(a)))) << a;
  }
  EXPECT_EQ(FastLog(1), 0);
}

}  // namespace
}  // namespace aisle::slam::dynamic
