#include "slam/dynamic/dynamic_detector.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/dynamic/dynamic_stages.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam {
namespace {

bool Same(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  return a.empty() || cv::norm(a, b, cv::NORM_INF) == 0;
}

/// Somebody crosses the aisle before a rig that drives on.
std::vector<test::SyntheticView> Crossing() {
  std::vector<test::Panel> panels = test::StaticHall();
  panels.push_back(test::Walker({-0.9, 0.15, 3}, {1.2, 0, 0}));
  std::vector<test::SyntheticView> film;
  for (int k = 0; k < 6; ++k) {
    Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
    T_world_rig.translation().z() = 0.05 * k;
    film.push_back(test::Render(panels, test::kHalfCamera, T_world_rig, 0.05 * k, 1.0));
  }
  return film;
}

/// The image as part of a larger one, whose other pixels are noise.
cv::Mat1b Within(const cv::Mat1b& image) {
  cv::Mat1b larger(image.rows + 80, image.cols + 80);
  cv::RNG random(9);
  random.fill(larger, cv::RNG::UNIFORM, 0, 256);
  cv::Mat1b part = larger(cv::Rect(40, 40, image.cols, image.rows));
  image.copyTo(part);
  return part;
}

DynamicDetector DetectorWith(DynamicMethod method) {
  DynamicOptions options;
  options.method = method;
  options.keep_stages = true;
  options.paper.disparity.half_size = false;
  return {test::kHalfCamera, options};
}

/// What either method measures of the images, before it decides upon it.
std::vector<cv::Mat> Measured(const DynamicStages& stages) {
  std::vector<cv::Mat> measured;
  if (stages.paper) {
    measured.push_back(stages.paper->stages.disparity);
    for (const dynamic::Track& track : stages.paper->stages.tracks) {
      measured.push_back(
          cv::Mat1f({track.previous.x, track.previous.y, track.current.x, track.current.y}));
    }
  }
  if (stages.robust) {
    measured = {stages.robust->stages.half_disparity, stages.robust->residual};
  }
  return measured;
}

TEST(DynamicDetector, WhatLiesAroundAnImageChangesNoBit) {
  const std::vector<test::SyntheticView> film = Crossing();
  for (const DynamicMethod method : {DynamicMethod::kPaper, DynamicMethod::kRobust}) {
    DynamicDetector alone = DetectorWith(method), within = DetectorWith(method);
    std::int64_t stamp_ns = 0;
    int moving = 0;
    for (const test::SyntheticView& view : film) {
      const DynamicOutput a = alone.Detect({stamp_ns, view.left, view.right});
      const DynamicOutput b = within.Detect({stamp_ns, Within(view.left), Within(view.right)});
      stamp_ns += 50'000'000;
      EXPECT_TRUE(std::ranges::equal(Measured(*a.stages), Measured(*b.stages), Same)) << stamp_ns;
      EXPECT_TRUE(Same(a.regions.mask, b.regions.mask)) << stamp_ns;
      EXPECT_TRUE(Same(a.mask_right, b.mask_right)) << stamp_ns;
      EXPECT_TRUE(Same(a.probability, b.probability)) << stamp_ns;
      if (!a.regions.mask.empty()) moving += cv::countNonZero(a.regions.mask);
    }
    EXPECT_GT(moving, 1000) << "the method saw nobody";
  }
}

TEST(ShiftMaskToRight, PutsAMaskWhereTheRightCameraSeesTheSame) {
  cv::Mat1b mask(60, 100, std::uint8_t{0});
  mask(cv::Rect(50, 20, 30, 20)) = 255;
  const cv::Mat1b shifted = [] {
    cv::Mat1b there(60, 100, std::uint8_t{0});
    there(cv::Rect(38, 20, 30, 20)) = 255;
    return there;
  }();
  EXPECT_TRUE(Same(ShiftMaskToRight(mask, cv::Mat1f(60, 100, 12.0F)), shifted));
  EXPECT_TRUE(Same(ShiftMaskToRight(mask, cv::Mat1f(30, 50, 6.0F)), shifted)) << "of half the size";
  EXPECT_EQ(cv::countNonZero(ShiftMaskToRight(mask, cv::Mat1f(60, 100, -1.0F))), 0) << "unknown";
  EXPECT_EQ(cv::countNonZero(ShiftMaskToRight(mask, cv::Mat1f(60, 100, 90.0F))), 0) << "outside";
  EXPECT_THROW(ShiftMaskToRight(mask, {}), cv::Exception);
}

}  // namespace
}  // namespace aisle::slam
