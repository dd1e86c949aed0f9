#include "slam/dynamic/paper/paper_method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Scene {
  std::vector<test::Panel> panels = test::StaticHall();
  Isometry3d T_world_first = Isometry3d::Identity(), T_world_second = Isometry3d::Identity();
};

struct Outcome {
  PaperResult result;
  test::SyntheticView truth;
};

/// Two frames a twentieth of a second apart.
Outcome Detect(const Scene& scene, const PaperOptions& options = {}) {
  const auto before = test::Render(scene.panels, {}, scene.T_world_first, 0);
  Outcome outcome{{}, test::Render(scene.panels, {}, scene.T_world_second, 0.05)};
  outcome.result = DetectDynamicRegions({before.left, before.right},
                                        {outcome.truth.left, outcome.truth.right}, options);
  return outcome;
}

Isometry3d Forward(double metres) {
  Isometry3d T = Isometry3d::Identity();
  T.translation().z() = metres;
  return T;
}

cv::Rect TrueBox(const cv::Mat1b& moving) {
  cv::Rect box;
  for (int y = 0; y < moving.rows; ++y) {
    for (int x = 0; x < moving.cols; ++x) {
      if (moving(y, x) != 0) box = box.empty() ? cv::Rect(x, y, 1, 1) : box | cv::Rect(x, y, 1, 1);
    }
  }
  return box;
}

double IntersectionOverUnion(const cv::Rect& a, const cv::Rect& b) {
  const double both = (a & b).area();
  return both / (a.area() + b.area() - both);
}

double MaskedShare(const cv::Mat1b& mask) {
  return static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
}

TEST(PaperMethod, FindsAWalkerThatCrossesADrivingCamera) {
  Scene scene;
  scene.T_world_second = Forward(0.03);
  scene.panels.push_back(test::Walker({0.2, 0.1, 3.5}, {1.2, 0, 0}));
  const Outcome outcome = Detect(scene);
  ASSERT_FALSE(outcome.result.dynamic.regions.empty());
  // One region or, where the points are sparse, a few: all of them on the walker.
  const cv::Rect walker = TrueBox(outcome.truth.moving);
  for (const DynamicRegion& region : outcome.result.dynamic.regions) {
    EXPECT_GT((region.box & walker).area(), region.box.area() / 2);
  }
}

TEST(PaperMethod, FindsAWalkerBeforeAStandingCamera) {
  Scene scene;
  scene.panels.push_back(test::Walker({-0.4, 0.1, 3.0}, {1.2, 0, 0}));
  const Outcome outcome = Detect(scene);
  ASSERT_GE(outcome.result.dynamic.regions.size(), 1U);
  EXPECT_GT(
      IntersectionOverUnion(outcome.result.dynamic.regions[0].box, TrueBox(outcome.truth.moving)),
      0.6);
}

TEST(PaperMethod, WithoutTheRuleForStandingCamerasTheMatrixExplainsTheWalkerAway) {
  Scene scene;
  scene.panels.push_back(test::Walker({-0.4, 0.1, 3.0}, {1.2, 0, 0}));
  PaperOptions options;  // as many points and thresholds as wide as a matrix needs for that
  options.spread.points = 500;
  options.fundamental.inlier_px = 0.5;
  options.epipolar = {.alpha_px = 0.8, .beta = 0.01};
  options.fundamental.standing_flow_px = 0;
  EXPECT_TRUE(Detect(scene, options).result.dynamic.regions.empty());
}

TEST(PaperMethod, NeverMakesOneRegionOfTwoWalkers) {
  Scene scene;
  scene.T_world_second = Forward(0.03);
  scene.panels.push_back(test::Walker({-0.9, 0.1, 3.5}, {1.2, 0, 0}));
  scene.panels.push_back(test::Walker({0.9, 0.1, 4.0}, {-1.2, 0, 0}));
  const auto dynamic = Detect(scene).result.dynamic;
  ASSERT_FALSE(dynamic.regions.empty());
  const int middle = StereoCamera{}.width / 2;
  for (const DynamicRegion& region : dynamic.regions) {
    EXPECT_FALSE(region.box.x < middle && region.box.br().x > middle) << region.box;
  }
}

TEST(PaperMethod, LeavesAStaticHallAlone) {
  for (const double metres : {0.0, 0.03, 0.1}) {
    Scene scene;
    scene.T_world_second = Forward(metres);
    EXPECT_LT(MaskedShare(Detect(scene).result.dynamic.mask), 0.01) << metres << " m";
  }
}

TEST(PaperMethod, TheMaskIsTheUnionOfTheRectangles) {
  Scene scene;
  scene.panels.push_back(test::Walker({-0.4, 0.1, 3.0}, {1.2, 0, 0}));
  const auto dynamic = Detect(scene).result.dynamic;
  cv::Mat1b expected(dynamic.mask.size(), 0);
  for (const DynamicRegion& region : dynamic.regions) expected(region.box).setTo(255);
  EXPECT_EQ(cv::norm(dynamic.mask, expected, cv::NORM_INF), 0);
}

TEST(PaperMethod, GivesTheSameBitsTwice) {
  Scene scene;
  scene.T_world_second = Forward(0.03);
  scene.panels.push_back(test::Walker({0.2, 0.1, 3.5}, {1.2, 0, 0}));
  const auto a = Detect(scene).result, b = Detect(scene).result;
  EXPECT_EQ(cv::norm(a.dynamic.mask, b.dynamic.mask, cv::NORM_INF), 0);
  EXPECT_EQ(a.stages.fundamental.F, b.stages.fundamental.F);
}

TEST(PaperMethod, SurvivesImagesWithoutContent) {
  for (const int grey : {0, 128, 255}) {
    const StereoPair blank{cv::Mat1b(480, 752, static_cast<unsigned char>(grey)),
                           cv::Mat1b(480, 752, static_cast<unsigned char>(grey))};
    const auto result = DetectDynamicRegions(blank, blank, {});
    EXPECT_EQ(cv::countNonZero(result.dynamic.mask), 0);
    EXPECT_EQ(result.dynamic.mask.size(), blank.left.size());
  }
}

TEST(PaperOptions, DefaultsAreValidAndBrokenRulesAreNamed) {
  PaperOptions options;
  EXPECT_EQ(Validate(options), "");
  options.boundary.lambda_hinge = 20;
  EXPECT_THAT(Validate(options), testing::HasSubstr("lambda_hinge"));
  options = {};
  options.disparity.max_disparity_px = 100;
  EXPECT_THAT(Validate(options), testing::HasSubstr("multiple of 16"));
}

}  // namespace
}  // namespace aisle::slam::dynamic
