#include "slam/dynamic/robust/robust_method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "slam/common/parallel.h"
#include "slam/dynamic/dynamic_detector.h"
#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kStep = 0.05;  // seconds between frames
constexpr std::int64_t kStepNs = 50'000'000;

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

/// OpenCV's own threads, as many as they were when this ends.
class OpenCvThreads {
 public:
  explicit OpenCvThreads(int threads) : before_(cv::getNumThreads()) { cv::setNumThreads(threads); }
  OpenCvThreads(const OpenCvThreads&) = delete;
  OpenCvThreads& operator=(const OpenCvThreads&) = delete;
  ~OpenCvThreads() { cv::setNumThreads(before_); }

 private:
  int before_;
};

/// Every frame of a film, on so many threads.
std::vector<RobustResult> StepThrough(const std::vector<test::SyntheticView>& film, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  const OpenCvThreads of_opencv(threads);
  return Arena(threads).Execute([&] {
    std::vector<RobustResult> results;
    RobustState state;
    for (const test::SyntheticView& view : film) {
      const auto stamp_ns = static_cast<std::int64_t>(results.size()) * 50'000'000;
      results.push_back(
          StepRobust(state, {view.left, view.right}, stamp_ns, {}, test::kHalfCamera, {}));
      state = results.back().state;
    }
    return results;
  });
}

/// So long a drive that all gaps have had their turn.
TEST(RobustMethod, OneThreadAndManyGiveTheSameBits) {
  auto panels = test::StaticHall();
  panels.push_back(test::Walker({-0.9, 0.1, 3.0}, {1.2, 0, 0}));
  std::vector<test::SyntheticView> film;
  for (int k = 0; k < 24; ++k) {
    const Isometry3d T_world_rig(Eigen::Translation3d(0, 0, 0.015 * k));
    film.push_back(test::Render(panels, test::kHalfCamera, T_world_rig, k * kStep));
  }
  const std::vector<RobustResult> one = StepThrough(film, 1), many = StepThrough(film, 4);
  std::set<std::size_t> slots;
  std::size_t regions = 0;
  for (std::size_t k = 0; k < film.size(); ++k) {
    SCOPED_TRACE(k);
    const auto same = [&](const auto& image_of) {
      const cv::Mat a = image_of(one[k]), b = image_of(many[k]);
      return a.size() == b.size() && (a.empty() || cv::norm(a, b, cv::NORM_INF) == 0);
    };
    EXPECT_TRUE(same([](const RobustResult& r) { return r.dynamic.mask; }));
    EXPECT_TRUE(same([](const RobustResult& r) { return r.probability; }));
    EXPECT_TRUE(same([](const RobustResult& r) { return r.half_disparity; }));
    EXPECT_TRUE(same([](const RobustResult& r) { return r.state.memory.log_odds; }));
    EXPECT_TRUE(same([](const RobustResult& r) { return r.state.memory.long_log_odds; }));
    EXPECT_TRUE(same([](const RobustResult& r) { return r.state.memory.long_per_step; }));
    EXPECT_TRUE(same([](const RobustResult& r) { return r.state.memory.regions.labels; }));
    EXPECT_EQ(one[k].state.noise.flow, many[k].state.noise.flow);
    ASSERT_EQ(one[k].motion.has_value(), many[k].motion.has_value());
    EXPECT_EQ(one[k].motion.has_value(), k > 0);
    if (one[k].motion) {
      EXPECT_EQ(one[k].motion->T_now_before.matrix(), many[k].motion->T_now_before.matrix());
      EXPECT_EQ(one[k].motion->covariance, many[k].motion->covariance);
    }
    ASSERT_EQ(one[k].dynamic.regions.size(), many[k].dynamic.regions.size());
    for (std::size_t i = 0; i < one[k].dynamic.regions.size(); ++i, ++regions) {
      const DynamicRegion &a = one[k].dynamic.regions[i], &b = many[k].dynamic.regions[i];
      EXPECT_EQ(a.id, b.id);
      EXPECT_EQ(a.box, b.box);
      EXPECT_EQ(a.evidence, b.evidence);
    }
    for (const GapTrace& gap : one[k].stages.gaps) slots.insert(gap.way.slot);
  }
  EXPECT_EQ(slots.size(), kSlots) << "a gap took no part";
  EXPECT_GT(regions, 10U);
}

/// A walker before a rig that drives at 0.3 m/s; the pictures go on after the pause as before it.
RobustResult StepAt(const RobustState& before, int k, std::int64_t stamp_ns,
                    const KnownMotion& known = {}) {
  auto panels = test::StaticHall();
  panels.push_back(test::Walker({-0.9, 0.1, 3.0}, {1.2, 0, 0}));
  const Isometry3d T_world_rig(Eigen::Translation3d(0, 0, 0.015 * k));
  const auto view = test::Render(panels, test::kHalfCamera, T_world_rig, k * kStep);
  return StepRobust(before, {view.left, view.right}, stamp_ns, known, test::kHalfCamera, {});
}

RobustResult LastOfEight() {
  RobustResult result;
  for (int k = 0; k < 8; ++k) result = StepAt(result.state, k, k * kStepNs);
  return result;
}

MeasuredMotion Ahead(double metres) {
  return {Isometry3d(Eigen::Translation3d(0, 0, -metres)), 1e-6 * Matrix6d::Identity()};
}

TEST(RobustMethod, AfterALongPauseItBeginsAnew) {
  const RobustResult before = LastOfEight();
  ASSERT_GT(cv::countNonZero(before.dynamic.mask), 500);
  ASSERT_TRUE(before.motion);
  // Whatever is expected, and even where the way is known: he has gone elsewhere meanwhile.
  for (const KnownMotion& known :
       {KnownMotion{}, KnownMotion{Ahead(0.015), {}}, KnownMotion{{}, Ahead(0.015)}}) {
    const RobustResult after = StepAt(before.state, 8, 8 * kStepNs + 10'000'000'000, known);
    EXPECT_FALSE(after.motion);
    EXPECT_TRUE(after.stages.gaps.empty());
    EXPECT_EQ(cv::countNonZero(after.dynamic.mask), 0);
    EXPECT_TRUE(after.dynamic.regions.empty());
    EXPECT_EQ(after.state.frames.size(), 1U);
    EXPECT_EQ(after.state.noise.flow, before.state.noise.flow);
    EXPECT_EQ(after.state.noise.match, before.state.noise.match);
    EXPECT_EQ(after.state.memory.regions.next_id, before.state.memory.regions.next_id);
    const RobustResult next = StepAt(after.state, 9, 9 * kStepNs + 10'000'000'000);
    ASSERT_TRUE(next.motion);
    EXPECT_NEAR(next.motion->T_now_before.translation().z(), -0.015, 0.01);
  }
}

TEST(RobustMethod, OverAShortPauseOrAKnownWayItGoesOn) {
  const RobustState before = LastOfEight().state;
  EXPECT_TRUE(StepAt(before, 8, 7 * kStepNs + 450'000'000).motion);
  EXPECT_FALSE(StepAt(before, 8, 7 * kStepNs + 1'500'000'000).motion);
  EXPECT_TRUE(StepAt(before, 8, 7 * kStepNs + 1'500'000'000, {{}, Ahead(0.015)}).motion);
}

TEST(RobustMethod, ASlowCameraHasAPast) {
  for (const std::int64_t step_ns : {500'000'000LL, 1'000'000'000LL}) {
    RobustState state;
    for (int k = 0; k < 5; ++k) {
      RobustResult result = StepAt(state, k, k * step_ns);
      ASSERT_EQ(result.motion.has_value(), k > 0) << k << " steps of " << step_ns << " ns";
      state = std::move(result.state);
    }
    // One that is lost between makes no difference to it.
    EXPECT_TRUE(StepAt(state, 6, 6 * step_ns).motion) << step_ns << " ns";
  }
}

TEST(RobustMethod, RefusesWhatItIsNotMadeFor) {
  const cv::Mat1b image(test::kHalfCamera.height, test::kHalfCamera.width, 90);
  const cv::Mat1b other(480, 752, 90);
  const auto step = [](const RobustState& before, const StereoPair& images, std::int64_t stamp_ns) {
    return StepRobust(before, images, stamp_ns, {}, test::kHalfCamera, {});
  };
  EXPECT_THROW(step({}, {other, other}, 0), cv::Exception);
  EXPECT_THROW(step({}, {image, other}, 0), cv::Exception);
  EXPECT_NO_THROW(step({}, {image, image}, 0));
  const RobustState before = StepAt({}, 0, kStepNs).state;
  EXPECT_THROW(step(before, {image, image}, kStepNs), cv::Exception);
  EXPECT_NO_THROW(step(before, {image, image}, kStepNs + 1));
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

/// The camera delivers nothing for ten seconds, then a good picture.
TEST(DynamicDetector, AfterALongPauseNothingIsSaid) {
  auto panels = test::StaticHall();
  panels.push_back(test::Walker({-0.9, 0.1, 3.0}, {1.2, 0, 0}));
  DynamicOptions options;
  options.method = DynamicMethod::kRobust;
  DynamicDetector detector(test::kHalfCamera, options);
  for (int k = 0; k < 9; ++k) {
    const Isometry3d T_world_rig(Eigen::Translation3d(0, 0, kStep * k));
    const auto view = test::Render(panels, test::kHalfCamera, T_world_rig, k * kStep);
    const bool paused = k == 8;
    const DynamicOutput output =
        detector.Detect({k * kStepNs + (paused ? 10'000'000'000 : 0), view.left, view.right});
    EXPECT_EQ(output.rig_motion.has_value(), k > 0 && !paused) << k;
    const int masked = cv::countNonZero(output.regions.mask);
    EXPECT_TRUE(k != 7 || masked > 500) << masked;
    EXPECT_TRUE(!paused || masked == 0) << masked;
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
