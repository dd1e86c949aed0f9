#include "simulator/proof/picture_change.h"

#include <gmock/gmock.h>

namespace aisle::sim {
namespace {

constexpr int kWidth = 480, kHeight = 360;

float Texture(double x, double y) {
  return static_cast<float>(120 + 40 * std::sin(0.11 * x) * std::cos(0.07 * y));
}

/// A textured wall that slides `shift` pixels to the right a picture, `brighter` grey levels
/// brighter each time, with noise of its own.
PictureWithFlow Sliding(int k, int shift, float brighter, double noise) {
  PictureWithFlow picture;
  picture.grey.create(kHeight, kWidth);
  cv::RNG random(static_cast<std::uint64_t>(k) + 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      picture.grey(y, x) = Texture(x - k * shift, y) + static_cast<float>(k) * brighter +
                           static_cast<float>(random.gaussian(noise));
    }
  }
  picture.depth = cv::Mat1f(kHeight, kWidth, 4.0f);
  picture.z_next = picture.depth;
  picture.instance = cv::Mat1w(kHeight, kWidth, std::uint16_t{1});
  picture.mover = cv::Mat1b(kHeight, kWidth, std::uint8_t{0});
  picture.shadow = picture.mover.clone();
  picture.flow = cv::Mat2f(kHeight, kWidth, cv::Vec2f(static_cast<float>(shift), 0));
  return picture;
}

PictureChanges Compare(int shift, float brighter, double noise) {
  return CompareInTime(Sliding(0, shift, brighter, noise), Sliding(1, shift, brighter, noise),
                       Sliding(2, shift, brighter, noise));
}

TEST(PictureChange, WhatOnlyMovesDoesNotChange) {
  const PictureChanges changes = Compare(3, 0, 0);
  EXPECT_GT(changes.statics.compared, 10000);
  EXPECT_LT(changes.statics.rms, 1e-4);
  EXPECT_LT(changes.statics.flicker, 1e-4);
  EXPECT_EQ(changes.movers.compared, 0);
  EXPECT_EQ(FailureOf(changes), "");
}

TEST(PictureChange, NoiseIsFlickerAndAsMuchOfItAsOfChange) {
  constexpr double kNoise = 9;
  const PictureChanges changes = Compare(3, 0, kNoise);
  const double expected = kNoise * std::sqrt(2.0) / 9;  // of means over 81 pixels
  EXPECT_NEAR(changes.statics.rms, expected, 0.1 * expected);
  EXPECT_NEAR(changes.statics.flicker, expected, 0.1 * expected);
}

TEST(PictureChange, LightThatGrowsEvenlyIsChangeButNoFlicker) {
  const PictureChanges changes = Compare(-2, 4, 0);
  EXPECT_NEAR(changes.statics.rms, 4, 1e-3);
  EXPECT_LT(changes.statics.flicker, 1e-3);
  EXPECT_THAT(FailureOf(changes), testing::HasSubstr("things at rest change by 4.00"));
}

TEST(PictureChange, WhatIsHiddenThenOrShowsAnotherThingDoesNotCount) {
  PictureWithFlow now = Sliding(0, 3, 0, 0), next = Sliding(1, 3, 0, 0);
  const int whole = cv::countNonZero(ChangeAlongFlow(now, next) == 0);
  const cv::Rect other(60, 40, 30, 30);
  next.instance(other) = 2;
  next.grey(other) = 255;
  const cv::Mat1f change = ChangeAlongFlow(now, next);
  int known = 0;
  for (const float value : change) {
    if (std::isnan(value)) continue;
    EXPECT_LT(std::abs(value), 1e-3);
    ++known;
  }
  EXPECT_GT(whole, 0);
  EXPECT_LT(known, kWidth * kHeight - other.area());
  EXPECT_GT(known, kWidth * kHeight / 2);
  now.z_next.setTo(5);  // something nearer stands there then
  for (const float value : ChangeAlongFlow(now, next)) EXPECT_TRUE(std::isnan(value));
}

TEST(PictureChange, IsToldApartByWhatShows) {
  PictureWithFlow first = Sliding(0, 0, 0, 0);
  PictureWithFlow second = Sliding(1, 0, 0, 0), third = Sliding(2, 0, 0, 0);
  const cv::Rect left(0, 0, kWidth / 2, kHeight),
      low(kWidth / 2, kHeight / 2, kWidth / 2, kHeight / 2);
  for (PictureWithFlow* picture : {&first, &second, &third}) {
    picture->mover(left) = 255;
    picture->instance(left) = 2;
    picture->shadow(low) = 255;
  }
  second.grey(left) += 6.0f;
  third.grey(low) += 3.0f;
  const PictureChanges changes = CompareInTime(first, second, third);
  const double quartile = 1.1503;  // of a Gaussian's amount: here all changes are equal
  EXPECT_NEAR(changes.movers.flicker, 12 / std::sqrt(3) / quartile, 1e-3);
  EXPECT_NEAR(changes.shadows.flicker, 3 / std::sqrt(3) / quartile, 1e-3);
  EXPECT_LT(changes.statics.flicker, 1e-3);
  EXPECT_GT(changes.statics.compared, 0);
  EXPECT_THAT(FailureOf(changes), testing::HasSubstr("movers flicker"));
}

}  // namespace
}  // namespace aisle::sim
