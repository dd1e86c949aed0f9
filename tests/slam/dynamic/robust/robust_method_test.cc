#include "slam/dynamic/robust/robust_method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "slam/dynamic/dynamic_detector.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kStep = 0.05;  // seconds between frames

struct Story {
  std::vector<test::Panel> movers = {};
  double speed_mps = 0;  // of the camera, forward
  double yaw_radps = 0;
  int frames = 12;
  double grey_noise = 2;
  int black_at = -1;  // the frame of which the camera delivered nothing but black
};

struct Totals {
  double both = 0, either = 0, truth = 0, static_masked = 0;
  std::set<int> ids;  // of the regions, from the fourth frame on
  double IntersectionOverUnion() const { return both / either; }
  double Recall() const { return both / truth; }
};

/// Plays a story in the hall; the first three frames, which have no past, do not count.
Totals Play(const Story& story) {
  auto panels = test::StaticHall();
  panels.insert(panels.end(), story.movers.begin(), story.movers.end());
  Isometry3d T_world_rig = Isometry3d::Identity();
  RobustState state;
  Totals totals;
  for (int k = 0; k < story.frames; ++k) {
    auto view = test::Render(panels, {}, T_world_rig, k * kStep, story.grey_noise);
    if (k == story.black_at) {
      const auto dark = test::Render({}, {}, T_world_rig, k * kStep, story.grey_noise);
      view.left = dark.left;
      view.right = dark.right;
    }
    RobustResult result = StepRobust(state, {view.left, view.right}, k * 50'000'000LL, {}, {}, {});
    state = std::move(result.state);
    T_world_rig = T_world_rig * Eigen::Translation3d(0, 0, story.speed_mps * kStep) *
                  Eigen::AngleAxisd(story.yaw_radps * kStep, Vector3d::UnitY());
    if (k < 3 || k == story.black_at) continue;
    const cv::Mat1b& mask = result.dynamic.mask;
    cv::Mat1b both, either;
    cv::bitwise_and(mask, view.moving, both);
    cv::bitwise_or(mask, view.moving, either);
    totals.both += cv::countNonZero(both);
    totals.either += cv::countNonZero(either);
    totals.truth += cv::countNonZero(view.moving);
    totals.static_masked +=
        static_cast<double>(cv::countNonZero(either) - cv::countNonZero(view.moving)) /
        static_cast<double>(mask.total()) / (story.frames - 3);
    for (const DynamicRegion& region : result.dynamic.regions) totals.ids.insert(region.id);
  }
  return totals;
}

TEST(RobustMethod, LeavesAStaticHallAlone) {
  EXPECT_LT(Play({}).static_masked, 0.015);
  EXPECT_LT(Play({.speed_mps = 0.6}).static_masked, 0.015);
  EXPECT_LT(Play({.speed_mps = 0.3, .yaw_radps = 0.4}).static_masked, 0.015);
}

TEST(RobustMethod, MasksAWalkerBeforeAStandingCamera) {
  const Totals totals = Play({.movers = {test::Walker({-0.6, 0.1, 3.2}, {1.2, 0, 0})}});
  EXPECT_GT(totals.Recall(), 0.85);
  EXPECT_GT(totals.IntersectionOverUnion(), 0.6);
}

TEST(RobustMethod, AnOddLastRowAndColumnAreAsThoseBesideThem) {
  StereoCamera odd, even;
  odd.width = even.width + 1;
  odd.height = even.height + 1;
  const cv::Rect whole(0, 0, odd.width, odd.height), inner(0, 0, even.width, even.height);
  auto panels = test::StaticHall();
  panels.push_back(test::Walker({2.3, 0.6, 3.2}, {1.2, 0, 0}));  // leaves at the right edge
  RobustState of_odd, of_even;
  int at_edge = 0;
  for (int k = 0; k < 8; ++k) {
    const auto view = test::Render(panels, odd, Isometry3d::Identity(), k * kStep);
    const std::int64_t stamp_ns = k * 50'000'000LL;
    RobustResult a = StepRobust(of_odd, {view.left, view.right}, stamp_ns, {}, odd, {});
    RobustResult b = StepRobust(of_even, {view.left(inner).clone(), view.right(inner).clone()},
                                stamp_ns, {}, even, {});
    of_odd = std::move(a.state);
    of_even = std::move(b.state);
    const cv::Mat1b& mask = a.dynamic.mask;
    ASSERT_EQ(mask.size(), whole.size());
    EXPECT_EQ(cv::norm(mask(inner), b.dynamic.mask, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(mask.col(even.width), mask.col(even.width - 1), cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(mask.row(even.height), mask.row(even.height - 1), cv::NORM_INF), 0);
    at_edge += cv::countNonZero(mask.col(even.width));
    ASSERT_EQ(a.dynamic.regions.size(), b.dynamic.regions.size());
    for (std::size_t i = 0; i < a.dynamic.regions.size(); ++i) {
      const cv::Rect box = a.dynamic.regions[i].box;
      EXPECT_EQ(box & inner, b.dynamic.regions[i].box);
      EXPECT_EQ(box & whole, box);
    }
  }
  EXPECT_GT(at_edge, 0);
}

TEST(RobustMethod, MasksAWalkerInTheNoiseOfLittleLight) {
  const Totals totals = Play({.movers = {test::Walker({-0.6, 0.1, 3.2}, {1.2, 0, 0})},
                              .speed_mps = 0.3,
                              .grey_noise = 40});
  EXPECT_GT(totals.Recall(), 0.8);  // 0.07 where the noise is left in
  EXPECT_GT(totals.IntersectionOverUnion(), 0.7);
}

TEST(RobustMethod, MasksAWalkerBeforeATurningCamera) {
  const Totals totals = Play({.movers = {test::Walker({-0.5, 0.1, 4.2}, {1.0, 0, 0})},
                              .speed_mps = 0.3,
                              .yaw_radps = 0.3});
  EXPECT_GT(totals.Recall(), 0.85);
  EXPECT_LT(totals.static_masked, 0.02);
}

TEST(RobustMethod, MasksAWalkerWhoComesAlongTheOpticalAxis) {
  const Totals totals =
      Play({.movers = {test::Walker({0.3, 0.1, 4.5}, {0, 0, -1.0})}, .speed_mps = 0.4});
  EXPECT_GT(totals.Recall(), 0.5);
}

TEST(RobustMethod, MasksATruckThatComesAsFastAsTheRigDrives) {
  test::Panel truck = test::Walker({-1.2, -0.1, 11.5}, {0, 0, -9.0});
  truck.half_width = 1.0;
  truck.half_height = 1.1;
  const Totals totals = Play({.movers = {truck}, .speed_mps = 9.0, .frames = 10});
  EXPECT_GT(totals.Recall(), 0.8);
  EXPECT_LT(totals.static_masked, 0.02);
}

TEST(RobustMethod, MasksAWalkerWhoLeadsTheWay) {
  const Totals totals = Play(
      {.movers = {test::Walker({0.2, 0.1, 2.6}, {0, 0, 0.6})}, .speed_mps = 0.6, .frames = 20});
  EXPECT_GT(totals.Recall(), 0.4);
}

TEST(RobustMethod, MasksASlowWalkerOnceTheLongGapSeesHim) {
  const Totals totals = Play(
      {.movers = {test::Walker({0.2, 0.1, 3.0}, {0.1, 0, 0})}, .speed_mps = 0.3, .frames = 24});
  EXPECT_GT(totals.Recall(), 0.4);
}

RobustResult LastOfFive(int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  auto panels = test::StaticHall();
  panels.push_back(test::Walker({-0.4, 0.1, 3.0}, {1.2, 0, 0}));
  RobustResult result;
  for (int k = 0; k < 5; ++k) {
    const auto view = test::Render(panels, {}, Isometry3d::Identity(), k * kStep);
    result = StepRobust(result.state, {view.left, view.right}, k * 50'000'000LL, {}, {}, {});
  }
  return result;
}

TEST(RobustMethod, TakesTheLongerGapsInTurn) {
  RobustState state;
  std::vector<std::vector<int>> gaps;
  for (int k = 0; k < 18; ++k) {
    const auto view = test::Render(test::StaticHall(), {}, Isometry3d::Identity(), k * kStep, 2.0);
    RobustResult result = StepRobust(state, {view.left, view.right}, k * 50'000'000LL, {}, {}, {});
    state = std::move(result.state);
    gaps.emplace_back();
    for (const GapTrace& gap : result.stages.gaps) gaps.back().push_back(gap.way.gap);
  }
  using Gaps = std::vector<int>;
  EXPECT_EQ(gaps[0], Gaps());
  EXPECT_EQ(gaps[4], Gaps({1}));
  for (std::size_t k = 5; k < 15; ++k) EXPECT_EQ(gaps[k], Gaps({1, 5})) << k;
  EXPECT_EQ(gaps[15], Gaps({1, 15}));
  EXPECT_EQ(gaps[16], Gaps({1, 5}));
  EXPECT_EQ(gaps[17], Gaps({1, 15}));
}

TEST(RobustMethod, ABlackFrameBetweenSaysNothing) {
  const Story story{.movers = {test::Walker({-0.6, 0.1, 3.2}, {1.2, 0, 0})}, .speed_mps = 0.5};
  Story interrupted = story;
  interrupted.black_at = 9;  // he is masked in the frame after it as if it had not been
  const Totals with = Play(interrupted), without = Play(story);
  EXPECT_GT(with.Recall(), without.Recall() - 0.02);
  EXPECT_LT(with.static_masked, without.static_masked + 0.005);
  EXPECT_EQ(with.ids, without.ids);
}

TEST(RobustMethod, OneThreadAndManyGiveTheSameBits) {
  const RobustResult one = LastOfFive(1), many = LastOfFive(4);
  EXPECT_EQ(cv::norm(one.dynamic.mask, many.dynamic.mask, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.probability, many.probability, cv::NORM_INF), 0);
}

TEST(RobustMethod, SurvivesImagesWithoutContentAndGoesOn) {
  RobustState state;
  const cv::Mat1b blank(480, 752, 90);
  for (int k = 0; k < 6; ++k) {
    const auto view = test::Render(test::StaticHall(), {}, Isometry3d::Identity(), k * kStep);
    const StereoPair pair =
        k == 2 || k == 3 ? StereoPair{blank, blank} : StereoPair{view.left, view.right};
    RobustResult result = StepRobust(state, pair, k * 50'000'000LL, {}, {}, {});
    EXPECT_EQ(cv::countNonZero(result.dynamic.mask), 0) << "frame " << k;
    state = std::move(result.state);
  }
}

TEST(RobustOptions, DefaultsAreValidAndBrokenRulesAreNamed) {
  DynamicOptions options;
  EXPECT_EQ(Validate(options), "");
  options.robust.field.memory = 1.5;
  EXPECT_THAT(Validate(options), testing::HasSubstr("memory"));
}

TEST(RobustOptions, EveryRuleIsCheckedAndNamed) {
  const auto broken = [](const auto& change) {
    RobustOptions options;
    change(options);
    return Validate(options);
  };
  using testing::HasSubstr;
  EXPECT_EQ(Validate(RobustOptions{}), "");
  EXPECT_THAT(broken([](auto& o) { o.surface.grey_noise = 0; }), HasSubstr("grey_noise is 0"));
  EXPECT_THAT(broken([](auto& o) { o.surface.brightness_noise = -1; }),
              HasSubstr("brightness_noise"));
  EXPECT_THAT(broken([](auto& o) { o.surface.window_px = 8; }), HasSubstr("window_px is 8"));
  EXPECT_THAT(broken([](auto& o) { o.flow.finest_scale = 9; }), HasSubstr("finest_scale"));
  EXPECT_THAT(broken([](auto& o) { o.tolerance.sigmas = 0; }), HasSubstr("tolerance.sigmas is 0"));
  EXPECT_THAT(broken([](auto& o) { o.ego.cell_px = 0; }), HasSubstr("cell_px"));
  EXPECT_THAT(broken([](auto& o) { o.evidence.least = 1; }), HasSubstr("least is 1"));
  EXPECT_THAT(broken([](auto& o) { o.evidence.edge_window_px = 4; }), HasSubstr("edge_window_px"));
  EXPECT_THAT(broken([](auto& o) { o.field.grow_link = 2; }), HasSubstr("grow_link"));
  EXPECT_THAT(broken([](auto& o) { o.region.keep_core_px = 900; }), HasSubstr("keep_core_px"));
}

TEST(DynamicDetector, BothMethodsMaskBothCameras) {
  auto panels = test::StaticHall();
  panels.push_back(test::Walker({-0.4, 0.1, 3.0}, {1.2, 0, 0}));
  for (const DynamicMethod method : {DynamicMethod::kPaper, DynamicMethod::kRobust}) {
    DynamicOptions options;
    options.method = method;
    DynamicDetector detector(StereoCamera{}, options);
    DynamicOutput output;
    for (int k = 0; k < 6; ++k) {
      const auto view = test::Render(panels, {}, Isometry3d::Identity(), k * kStep);
      output = detector.Detect({k * 50'000'000LL, view.left, view.right, {}});
    }
    ASSERT_GT(cv::countNonZero(output.regions.mask), 1000);
    // The walker is 3 m away: 17.4 px further to the left in the right camera.
    const double left = cv::mean(output.regions.mask.colRange(0, 752))[0];
    const double right = cv::mean(output.mask_right)[0];
    EXPECT_NEAR(right, left, 0.35 * left);
  }
}

/// Of a mask: the share of the image that it takes of what stands, and of a mover that it covers.
double StaticMasked(const cv::Mat1b& mask, const cv::Mat1b& moving) {
  return static_cast<double>(cv::countNonZero(mask & ~moving)) / static_cast<double>(mask.total());
}
double Covered(const cv::Mat1b& mask, const cv::Mat1b& moving) {
  return static_cast<double>(cv::countNonZero(mask & moving)) / cv::countNonZero(moving);
}

DynamicDetector RobustDetector() {
  DynamicOptions options;
  options.method = DynamicMethod::kRobust;
  return {StereoCamera{}, options};
}

/// The rig drives on at 1 m/s while its camera repeats a picture: for a while no vehicle could have
/// stopped so, then one could have; longer than a past is kept.
TEST(DynamicDetector, WhatStandsIsNotMaskedByACameraThatRepeatsItsPicture) {
  auto panels = test::StaticHall();
  panels.push_back(test::Walker({-0.6, 0.1, 3.8}, {0.8, 0, 0.3}));
  // Measured or not, the rig's own motion is that of going on.
  MeasuredMotion wheels{Isometry3d(Eigen::Translation3d(0, 0, -kStep)), {}};
  wheels.covariance = 1e-6 * Matrix6d::Identity();
  for (const auto& [copies, measured] :
       {std::pair(1, false), std::pair(3, false), std::pair(12, false), std::pair(3, true)}) {
    DynamicDetector detector = RobustDetector();
    test::SyntheticView view;
    std::set<int> ids;
    for (int k = 0; k < 13 + copies; ++k) {
      const bool copy = k >= 9 && k < 9 + copies;
      const Isometry3d T_world_rig(Eigen::Translation3d(0, 0, kStep * k));
      if (!copy) view = test::Render(panels, {}, T_world_rig, k * kStep, 2);
      const DynamicOutput output =
          detector.Detect({k * 50'000'000LL,
                           view.left.clone(),
                           view.right.clone(),
                           {},
                           measured && k > 0 ? std::optional(wheels) : std::nullopt});
      if (k < 8) continue;
      EXPECT_LT(StaticMasked(output.regions.mask, view.moving), 0.01) << k << " of " << copies;
      EXPECT_FALSE(copy && output.rig_motion) << k << " of " << copies;
      if (k >= 9 + 10) continue;  // nothing is where it was
      EXPECT_GT(Covered(output.regions.mask, view.moving), 0.9) << k << " of " << copies;
      for (const DynamicRegion& region : output.regions.regions) ids.insert(region.id);
      if (copy) continue;
      ASSERT_TRUE(output.rig_motion);
      const Vector3d way = output.rig_motion->T_now_before.translation();
      EXPECT_LT((way - Vector3d(0, 0, -kStep)).norm(), 0.003) << k << " of " << copies;
    }
    EXPECT_EQ(ids.size(), 1);
  }
}

TEST(RobustMethod, PicturesWithoutNoiseOfARigThatStandsAreAsGoodAsOthers) {
  const auto view = test::Render(test::StaticHall(), {}, Isometry3d::Identity(), 0, 0);
  RobustState state;
  for (int k = 0; k < 7; ++k) {
    RobustResult result = StepRobust(state, {view.left, view.right}, k * 50'000'000LL, {}, {}, {});
    state = std::move(result.state);
    EXPECT_EQ(state.frames.back().number, k);
    EXPECT_EQ(result.stages.gaps.empty(), k == 0);
  }
}

/// The caller's guesses are off by what he says of them: so far the motion over the frames that
/// nobody saw may be off.
TEST(DynamicDetector, TheMotionAfterBlackFramesErrsAsItsCovarianceSays) {
  DynamicDetector detector = RobustDetector();
  constexpr double kWay = 0.025, kDeviation = 0.008;
  for (int k = 0; k < 8; ++k) {
    const bool black = k == 5 || k == 6;
    const Isometry3d T_world_rig(Eigen::Translation3d(0, 0, kWay * k));
    const auto view = test::Render(black ? std::vector<test::Panel>() : test::StaticHall(), {},
                                   T_world_rig, k * kStep, 2);
    MeasuredMotion expected;
    expected.T_now_before.translation().z() = black ? kDeviation - kWay : -kWay;
    expected.covariance = kDeviation * kDeviation * Matrix6d::Identity();
    const DynamicOutput output =
        detector.Detect({k * 50'000'000LL, view.left, view.right, expected});
    ASSERT_EQ(output.rig_motion.has_value(), k > 0 && !black) << k;
    if (!output.rig_motion) continue;
    const Isometry3d truth(Eigen::Translation3d(0, 0, -kWay));
    const Vector6d error = Difference(truth, output.rig_motion->T_now_before);
    EXPECT_LT(error.dot(output.rig_motion->covariance.inverse() * error), 22.5) << k;  // 99.9 %
  }
}

TEST(DynamicDetector, WithoutAMethodNothingIsMasked) {
  DynamicDetector detector(StereoCamera{}, {});
  const cv::Mat1b image(480, 752, 90);
  EXPECT_TRUE(detector.Detect({0, image, image, {}}).regions.mask.empty());
}

TEST(ShiftMaskToRight, MovesEveryPixelByItsDisparity) {
  cv::Mat1b mask(60, 100, static_cast<unsigned char>(0));
  mask(cv::Rect(40, 20, 20, 20)).setTo(255);
  const cv::Mat1b same = ShiftMaskToRight(mask, cv::Mat1f(60, 100, 8.0F));
  const cv::Mat1b half = ShiftMaskToRight(mask, cv::Mat1f(30, 50, 4.0F));
  EXPECT_EQ(cv::norm(same, half, cv::NORM_INF), 0);
  EXPECT_EQ(same(30, 33), 255);
  EXPECT_EQ(same(30, 31), 0);
  EXPECT_EQ(same(30, 51), 255);
  EXPECT_EQ(same(30, 52), 0);
}

}  // namespace
}  // namespace aisle::slam::dynamic
