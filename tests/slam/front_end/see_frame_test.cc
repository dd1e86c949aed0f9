#include "slam/front_end/see_frame.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>
#include <random>

namespace aisle::slam {
namespace {

constexpr StereoCamera kCamera{
    .width = 320, .height = 240, .fx = 200, .fy = 200, .cx = 160, .cy = 120, .baseline_m = 0.12};
constexpr int kShift = 9;  // pixels of disparity, everywhere

cv::Mat1b RandomMask(unsigned seed) {
  cv::Mat1b mask(kCamera.height, kCamera.width);
  cv::RNG random(seed);
  random.fill(mask, cv::RNG::UNIFORM, 0, 2);
  mask *= 255;
  return mask;
}

/// A plane of blotches, parallel to both cameras.
StereoImages Plane() {
  cv::Mat1b wide(kCamera.height, kCamera.width + kShift);
  cv::RNG random(5);
  random.fill(wide, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(wide, wide, {7, 7}, 1.6);
  cv::normalize(wide, wide, 0, 255, cv::NORM_MINMAX);
  return {3, 150'000'000, wide(cv::Rect(0, 0, kCamera.width, kCamera.height)).clone(),
          wide(cv::Rect(kShift, 0, kCamera.width, kCamera.height)).clone()};
}

StereoSight SeeBoth(const ExternalMask& mask, const SlamOptions& options) {
  const StereoImages images = Plane();
  std::map<std::string, double> stage_ms;
  return SeeFrame(images, FindStereoCorners(images, options.feature), mask, kCamera, options,
                  stage_ms);
}

std::shared_ptr<const Frame> See(const ExternalMask& mask = {}, const SlamOptions& options = {}) {
  return SeeBoth(mask, options).frame;
}

TEST(Union, IsWhatEitherRejectsAndAnEmptyMaskRejectsNothing) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const cv::Mat1b a = RandomMask(seed), b = RandomMask(seed + 100), c = RandomMask(seed + 200);
    const auto same = [](const cv::Mat1b& x, const cv::Mat1b& y) {
      return cv::norm(x, y, cv::NORM_INF) == 0;
    };
    const cv::Mat1b both = Union(a, b);
    for (int y = 0; y < a.rows; ++y) {
      for (int x = 0; x < a.cols; ++x) {
        ASSERT_EQ(both(y, x) != 0, a(y, x) != 0 || b(y, x) != 0);
      }
    }
    EXPECT_TRUE(same(both, Union(b, a)));
    EXPECT_TRUE(same(Union(both, c), Union(a, Union(b, c))));
    EXPECT_TRUE(same(Union(a, a), a));
    EXPECT_TRUE(same(Union(a, {}), a));
    EXPECT_TRUE(same(Union({}, a), a));
  }
  EXPECT_TRUE(Union({}, {}).empty());
}

TEST(CheckImages, NamesTheImageThatHasNotTheCamerasSize) {
  const StereoImages good = Plane();
  EXPECT_NO_THROW(CheckImages(good, {}, kCamera));
  const cv::Mat1b small(10, 10, std::uint8_t{0});
  const auto complaint = [&](const StereoImages& images, const ExternalMask& mask) {
    try {
      CheckImages(images, mask, kCamera);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  StereoImages left = good, right = good, none = good;
  left.left = small;
  right.right = small;
  none.left.release();
  EXPECT_NE(complaint(left, {}).find("the left image is 10x10, the camera 320x240"),
            std::string::npos);
  EXPECT_NE(complaint(right, {}).find("frame 3: the right image"), std::string::npos);
  EXPECT_NE(complaint(none, {}).find("the left image is 0x0"), std::string::npos);
  EXPECT_NE(complaint(good, {.left = small, .right = {}, .confidence = {}}).find("the left mask"),
            std::string::npos);
  EXPECT_NE(complaint(good, {.left = {}, .right = small, .confidence = {}}).find("the right mask"),
            std::string::npos);
  EXPECT_NE(complaint(good, {.left = {}, .right = {}, .confidence = cv::Mat1f(3, 3, 1.0f)})
                .find("the confidence"),
            std::string::npos);
}

TEST(CheckImages, NamesThePixelWhoseConfidenceIsNoNumber) {
  for (const float wrong :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    ExternalMask mask;
    mask.confidence = cv::Mat1f(kCamera.height, kCamera.width, 1.0F);
    EXPECT_NO_THROW(CheckImages(Plane(), mask, kCamera));
    mask.confidence(7, 250) = wrong;
    try {
      CheckImages(Plane(), mask, kCamera);
      FAIL() << wrong << " is taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("the confidence at pixel (250, 7) is"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(SeeFrame, MeasuresTheDisparityThatIsThere) {
  const auto frame = See();
  EXPECT_EQ(frame->id, 3);
  EXPECT_EQ(frame->stamp_ns, 150'000'000);
  ASSERT_EQ(frame->measurements.size(), frame->features.keypoints.size());
  const SlamOptions options;
  int with_depth = 0, near = 0;
  for (std::size_t i = 0; i < frame->measurements.size(); ++i) {
    const Measurement& m = frame->measurements[i];
    EXPECT_EQ(m.uvd.x(), frame->features.keypoints[i].pixel.x);
    EXPECT_EQ(m.uvd.y(), frame->features.keypoints[i].pixel.y);
    const double scale = std::pow(options.feature.scale, frame->features.keypoints[i].level);
    EXPECT_NEAR(m.sigma_px, scale * options.keypoint_noise_px, 1e-9);
    if (!m.has_depth()) continue;
    ++with_depth;
    EXPECT_GE(m.sigma_d, scale * options.stereo.disparity_noise_px);
    near += std::abs(m.uvd.z() - kShift) < 0.1 * scale;
  }
  EXPECT_GT(with_depth, 100);
  EXPECT_GT(near, 0.97 * with_depth);
}

TEST(SeeFrame, TheRightCameraSeesByItselfOutsideItsMask) {
  ExternalMask mask;
  mask.right = cv::Mat1b(kCamera.height, kCamera.width, std::uint8_t{0});
  mask.right(cv::Rect(0, 0, kCamera.width / 2, kCamera.height)).setTo(255);
  const SlamOptions options;
  const auto right = SeeBoth(mask, options).right;
  ASSERT_TRUE(right);
  ASSERT_GT(right->size(), 50);
  ASSERT_EQ(std::ssize(right->measurements), right->size());
  for (std::size_t i = 0; i < right->measurements.size(); ++i) {
    const Measurement& m = right->measurements[i];
    EXPECT_TRUE(m.right);
    EXPECT_FALSE(m.has_depth());
    EXPECT_EQ(m.uvd.x(), right->features.keypoints[i].pixel.x);
    EXPECT_EQ(m.uvd.y(), right->features.keypoints[i].pixel.y);
    EXPECT_EQ(mask.right(static_cast<int>(m.uvd.y()), static_cast<int>(m.uvd.x())), 0);
    const double scale = std::pow(options.feature.scale, right->features.keypoints[i].level);
    EXPECT_NEAR(m.sigma_px, scale * options.keypoint_noise_px, 1e-9);
  }
}

TEST(SeeFrame, OrbSlam2DoesNotAskTheRightCameraByItself) {
  EXPECT_FALSE(SeeBoth({}, OptionsOf(Base::kOrbSlam2)).right);
}

TEST(TellsOfBoth, WhatIsSaidOfTheLeftImageAloneIsNotKnownInTheRightOne) {
  const cv::Mat1b some = RandomMask(1);
  EXPECT_TRUE(TellsOfBoth({}));
  EXPECT_TRUE(TellsOfBoth({some, some, {}}));
  EXPECT_TRUE(TellsOfBoth({{}, some, {}}));
  EXPECT_FALSE(TellsOfBoth({some, {}, {}}));
  EXPECT_FALSE(TellsOfBoth({some, some, cv::Mat1f(2, 2, 1.0F)}));
}

TEST(SeeFrame, SeesNothingUnderTheMaskAndAllWithoutOne) {
  ExternalMask nothing;
  nothing.left = cv::Mat1b(kCamera.height, kCamera.width, std::uint8_t{0});
  nothing.right = nothing.left.clone();
  const auto all = See(), same = See(nothing);
  ASSERT_EQ(all->size(), same->size());
  for (std::size_t i = 0; i < all->measurements.size(); ++i) {
    EXPECT_EQ(all->measurements[i].uvd, same->measurements[i].uvd);
  }
  ExternalMask half = nothing;
  half.left(cv::Rect(0, 0, kCamera.width / 2, kCamera.height)).setTo(255);
  const auto right = See(half);
  EXPECT_GT(right->size(), 50);
  for (const Measurement& m : right->measurements) {
    EXPECT_EQ(half.left(static_cast<int>(m.uvd.y()), static_cast<int>(m.uvd.x())), 0);
  }
  half.left.setTo(255);
  EXPECT_EQ(See(half)->size(), 0);
}

/// Information times confidence: deviations grow as its root, of the same places.
TEST(SeeFrame, TrustsAPixelAsFarAsItIsTold) {
  const auto plain = See();
  for (const float trust : {1.0f, 0.25f, 0.04f}) {
    ExternalMask told;
    told.confidence = cv::Mat1f(kCamera.height, kCamera.width, trust);
    const auto frame = See(told);
    ASSERT_EQ(frame->size(), plain->size());
    for (std::size_t i = 0; i < frame->measurements.size(); ++i) {
      const Measurement &a = frame->measurements[i], &b = plain->measurements[i];
      EXPECT_EQ(a.uvd, b.uvd);
      EXPECT_NEAR(a.sigma_px, b.sigma_px / std::sqrt(trust), 1e-5 * a.sigma_px);
      EXPECT_NEAR(a.sigma_d, b.sigma_d / std::sqrt(trust), 1e-5 * a.sigma_d + 1e-12);
    }
  }
  ExternalMask none;
  none.confidence = cv::Mat1f(kCamera.height, kCamera.width, 0.0f);
  const auto worthless = See(none);  // outlives the loop over what it holds
  for (const Measurement& m : worthless->measurements) {
    EXPECT_TRUE(std::isfinite(m.sigma_px)) << "a pixel worth nothing is worth hardly anything";
  }
}

TEST(SeeFrame, EqualColumnsMakeDisparityAsExactAsItsColumns) {
  SlamOptions options;
  options.equal_columns = true;
  const auto equal = See({}, options), plain = See();
  ASSERT_EQ(equal->size(), plain->size());
  for (std::size_t i = 0; i < equal->measurements.size(); ++i) {
    const Measurement &a = equal->measurements[i], &b = plain->measurements[i];
    EXPECT_EQ(a.has_depth(), b.has_depth());
    EXPECT_EQ(a.uvd, b.uvd);
    if (!a.has_depth()) continue;
    EXPECT_EQ(a.sigma_d, a.sigma_px);
    EXPECT_EQ(a.u_in_d, 1);
  }
}

}  // namespace
}  // namespace aisle::slam
