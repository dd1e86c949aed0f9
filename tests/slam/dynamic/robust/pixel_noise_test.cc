#include "slam/dynamic/robust/pixel_noise.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/robust/dense_frame.h"

namespace aisle::slam::dynamic {
namespace {

/// Of a value each, from left to right, dark to bright.
cv::Mat1f Ramp() {
  cv::Mat1f ramp(480, 752);
  for (int x = 0; x < ramp.cols; ++x) {
    ramp.col(x).setTo(40.0F + 170.0F * static_cast<float>(x) / static_cast<float>(ramp.cols));
  }
  return ramp;
}

/// With normal noise of so many grey levels, and more of the brightness.
cv::Mat1b Photographed(const cv::Mat1f& scene, double sigma, double share = 0) {
  cv::RNG random(7);
  cv::Mat1f noise(scene.size());
  random.fill(noise, cv::RNG::NORMAL, 0, 1);
  cv::multiply(noise, sigma + share * scene, noise);
  noise += scene;
  cv::Mat1b image;
  noise.convertTo(image, CV_8U);
  return image;
}

double Deviation(const GreyVariance& noise, std::size_t grey) { return std::sqrt(noise[grey]); }

TEST(MeasurePixelNoise, IsWhatImagesOfHalfSizeHave) {
  for (const double sigma : {0.7, 1.2, 3.0, 8.0}) {
    const cv::Mat1b image = Photographed(Ramp(), sigma);
    const cv::Mat1b half = HalfImage(image);
    cv::Mat1f clean, difference;
    cv::resize(Ramp(), clean, half.size(), 0, 0, cv::INTER_AREA);
    half.convertTo(difference, CV_32F);
    difference -= clean;
    cv::Scalar mean, deviation;
    cv::meanStdDev(difference, mean, deviation);
    const GreyVariance noise = MeasurePixelNoise(image);
    for (const std::size_t grey : {60U, 100U, 150U, 190U}) {
      // Half an image's grey values are rounded once more.
      EXPECT_NEAR(noise[grey] + 1.0 / 12, deviation[0] * deviation[0], 0.06 + 0.1 * noise[grey])
          << sigma << " at " << grey;
    }
  }
}

TEST(MeasurePixelNoise, GrowsWithBrightnessWhereTheSensorsDoes) {
  const GreyVariance noise = MeasurePixelNoise(Photographed(Ramp(), 1, 0.04));
  for (const double grey : {60.0, 100.0, 150.0, 190.0}) {
    const double expected = (1 + 0.04 * grey) / 2;
    EXPECT_NEAR(Deviation(noise, static_cast<std::size_t>(grey)), expected, 0.08 * expected);
  }
}

TEST(MeasurePixelNoise, IsNotTheScenesTexture) {
  cv::Mat1f scene = Ramp();
  for (int x = 0; x < scene.cols; x += 9) scene.col(x) += 60;  // bars a pixel wide
  scene(cv::Rect(100, 100, 150, 200)).setTo(30);               // goods
  cv::putText(scene, "PALLET 27", {120, 200}, cv::FONT_HERSHEY_SIMPLEX, 0.9, 250, 2);
  const GreyVariance noise = MeasurePixelNoise(Photographed(scene, 2));
  for (const std::size_t grey : {100U, 150U}) EXPECT_NEAR(Deviation(noise, grey), 1, 0.2) << grey;
}

TEST(MeasurePixelNoise, GreysThatAreRareHaveThatOfTheNearestOnes) {
  const cv::Mat1f grey(200, 200, 100.0F);
  const GreyVariance noise = MeasurePixelNoise(Photographed(grey, 1));
  EXPECT_FLOAT_EQ(noise[0], noise[100]);
  EXPECT_FLOAT_EQ(noise[255], noise[100]);
  const GreyVariance unknown = MeasurePixelNoise(cv::Mat1b(10, 10, std::uint8_t{100}));
  EXPECT_EQ(unknown[100], 0);
}

TEST(WithoutNoise, KeepsTheShareOfWhatDiffersThatIsNotNoise) {
  const cv::Mat1b image = Photographed(Ramp(), 6)(cv::Rect(100, 100, 57, 41)).clone();
  GreyVariance noise;
  for (std::size_t grey = 0; grey < noise.size(); ++grey) noise[grey] = static_cast<float>(grey);
  cv::Mat seen, mean, square, expected, found;
  image.convertTo(seen, CV_64F);
  cv::blur(seen, mean, {5, 5});
  cv::blur(seen.mul(seen), square, {5, 5});
  cv::Mat of_noise;
  mean.convertTo(of_noise, CV_64F);
  for (double& grey : cv::Mat1d(of_noise)) grey = std::floor(grey + 1e-9);
  const cv::Mat share = cv::max(1 - of_noise / (square - mean.mul(mean)), 0);
  expected = mean + share.mul(seen - mean);
  WithoutNoise(image, noise).convertTo(found, CV_64F);
  EXPECT_LT(cv::norm(found, expected, cv::NORM_INF), 0.501);
  EXPECT_EQ(cv::norm(image, WithoutNoise(image, GreyVariance{}), cv::NORM_INF), 0);
}

TEST(WithoutNoise, LeavesHalfAsMuchErrorOrLess) {
  cv::Mat1f scene = Ramp();
  scene(cv::Rect(200, 100, 150, 200)) += 60;  // an edge stays an edge
  cv::Mat1f clean;
  cv::resize(scene, clean, scene.size() / 2, 0, 0, cv::INTER_AREA);
  const auto error = [&](const cv::Mat1b& image) {
    cv::Mat1f difference;
    image.convertTo(difference, CV_32F);
    return cv::norm(difference, clean, cv::NORM_L2);
  };
  const cv::Mat1b image = Photographed(scene, 12);
  EXPECT_LT(error(QuietHalfImage(image, {})), error(HalfImage(image)) / 2);
}

/// An asphalt's grain of 1.5 grey levels, which the measure takes for noise: it is no more than
/// the method counts with.
TEST(QuietHalfImage, LeavesUsualNoiseAndFaintTextureAlone) {
  const cv::Mat1b image = Photographed(Ramp(), 3);
  EXPECT_GT(Deviation(MeasurePixelNoise(image), 100), 1.3);
  EXPECT_EQ(cv::norm(QuietHalfImage(image, {}), HalfImage(image), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace aisle::slam::dynamic
