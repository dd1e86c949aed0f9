#include "simulator/shade/reference/light_error.h"

#include <gtest/gtest.h>

namespace aisle::sim {
namespace {

cv::Mat1f Pattern() {
  cv::Mat1f image(64, 64);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image(y, x) = 0.3f + 0.2f * std::sin(0.5f * static_cast<float>(x)) *
                               std::cos(0.3f * static_cast<float>(y));
    }
  }
  return image;
}

TEST(CompareLight, EqualPicturesHaveNoError) {
  const LightError error = CompareLight(Pattern(), Pattern());
  EXPECT_EQ(error.median_relative, 0);
  EXPECT_NEAR(error.ssim, 1, 1e-6);
  EXPECT_NEAR(error.mean_ratio, 1, 1e-12);
}

TEST(CompareLight, ABrighterPictureIsOffByAsMuch) {
  cv::Mat1f brighter = Pattern();
  brighter *= 1.1;
  const LightError error = CompareLight(brighter, Pattern());
  EXPECT_NEAR(error.median_relative, 0.1, 1e-4);
  EXPECT_NEAR(error.mean_ratio, 1.1, 1e-4);
  EXPECT_GT(error.ssim, 0.95);  // structure is kept
}

TEST(CompareLight, AFlatPictureHasLostTheStructure) {
  EXPECT_LT(CompareLight(cv::Mat1f(64, 64, 0.3f), Pattern()).ssim, 0.3);
}

TEST(CompareLight, WhatIsOverWhiteIsWhite) {
  cv::Mat1f lamp = Pattern();
  lamp(cv::Rect(8, 8, 16, 16)) = 5;
  cv::Mat1f brighter_lamp = Pattern();
  brighter_lamp(cv::Rect(8, 8, 16, 16)) = 9;
  EXPECT_NEAR(CompareLight(brighter_lamp, lamp).ssim, 1, 1e-6);
}

TEST(LightChange, TellsTheErrorOfAChangeFromTheNoiseOfItsReference) {
  cv::RNG rng(3);
  cv::Mat1f change(200, 200), noise(200, 200), error(200, 200), ours;
  rng.fill(change, cv::RNG::NORMAL, 0.01, 0.05);
  rng.fill(noise, cv::RNG::NORMAL, 0, 0.004);
  rng.fill(error, cv::RNG::NORMAL, 0, 0.01);
  cv::add(change, error, ours);
  std::array<cv::Mat1f, 2> halves;  // their mean is the change, each is off by the noise
  cv::add(change, noise, halves[0]);
  cv::subtract(change, noise, halves[1]);
  cv::Mat1b where(200, 200, std::uint8_t{0});
  where.rowRange(50, 150).setTo(1);
  ours.rowRange(0, 50).setTo(9);  // is not asked for
  const LightChange found = CompareChange(ours, halves, where);
  EXPECT_EQ(found.pixels, 100 * 200);
  EXPECT_NEAR(found.rms_reference, std::hypot(0.01, 0.05), 0.001);
  EXPECT_NEAR(found.rms_between, 0.01, 0.0005);
  EXPECT_NEAR(found.rms_noise, 0.004, 0.0002);
  EXPECT_NEAR(found.correlation, 0.05 / std::hypot(0.05, 0.01), 0.003);
  EXPECT_NEAR(CompareChange(change, halves, where).correlation, 1, 1e-6);
}

}  // namespace
}  // namespace aisle::sim
