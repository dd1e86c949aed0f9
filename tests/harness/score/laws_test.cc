// Properties that hold for any trajectory, tried on random ones.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>
#include <tuple>

#include "harness/score/masks.h"
#include "harness/score/pose_error.h"
#include "harness/score/relative_error.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

double Real(double low, double high) {
  constexpr int kSteps = 1'000'000;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

Eigen::Isometry3d RandomPose(double extent_m) {
  Eigen::Quaterniond q(Real(0.1, 1), Real(-1, 1), Real(-1, 1), Real(-1, 1));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() << Real(-extent_m, extent_m), Real(-extent_m, extent_m),
      Real(-extent_m, extent_m);
  return pose;
}

Trajectory RandomTrajectory() {
  const int count = *rc::gen::inRange(5, 40);
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) trajectory.push_back({i * 50'000'000LL, RandomPose(5)});
  return trajectory;
}

Trajectory Noisy(const Trajectory& truth) {
  Trajectory noisy = truth;
  for (StampedPose& pose : noisy) pose.T_world_rig = pose.T_world_rig * RandomPose(0.2);
  return noisy;
}

/// The rule by its letter: all pairs within the bound, the closest first.
std::vector<PosePair> PairsOfAll(const Trajectory& truth, const Trajectory& estimate,
                                 std::int64_t bound_ns, bool may_cross) {
  std::vector<std::tuple<std::int64_t, std::size_t, std::size_t>> all;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t e = 0; e < estimate.size(); ++e) {
      const std::int64_t off = std::abs(truth[t].stamp_ns - estimate[e].stamp_ns);
      if (off <= bound_ns) all.emplace_back(off, t, e);
    }
  }
  std::ranges::sort(all);
  std::vector<PosePair> pairs;
  for (const auto& [off, t, e] : all) {
    const bool free = std::ranges::none_of(pairs, [&](const PosePair& pair) {
      const bool crosses = (pair.truth < t) != (pair.estimate < e);
      return pair.truth == t || pair.estimate == e || (crosses && !may_cross);
    });
    if (free) pairs.push_back({t, e});
  }
  std::ranges::sort(pairs, {}, &PosePair::truth);
  return pairs;
}

/// Rising stamps of which many are a few milliseconds apart, and so many differences are equal.
Trajectory RandomStamps() {
  Trajectory trajectory;
  std::int64_t stamp = *rc::gen::inRange(-20, 20) * 1'000'000LL;
  const int count = *rc::gen::inRange(0, 40);
  for (int i = 0; i < count; ++i) {
    trajectory.push_back({stamp, Eigen::Isometry3d::Identity()});
    stamp += *rc::gen::inRange(1, 12) * 1'000'000LL;
  }
  return trajectory;
}

Trajectory Moved(const Eigen::Isometry3d& T, const Trajectory& trajectory) {
  Trajectory moved = trajectory;
  for (StampedPose& pose : moved) pose.T_world_rig = T * pose.T_world_rig;
  return moved;
}

double AteRmse(const Trajectory& truth, const Trajectory& estimate) {
  return *ScoreTrajectory(truth, estimate).scores.at("ate_rmse_m").value;
}

TEST(ScoreLaws, TruthHeldAgainstItselfHasNoError) {
  EXPECT_TRUE(rc::check([] {
    const Trajectory truth = RandomTrajectory();
    const TrajectoryScore score = ScoreTrajectory(truth, truth);
    for (const char* name : {"ate_rmse_m", "rpe_trans_rmse_m", "ate_rot_rmse_deg"}) {
      RC_ASSERT(*score.scores.at(name).value < 1e-5);
    }
    RC_ASSERT(score.pairs.size() == truth.size());
  }));
}

TEST(ScoreLaws, AlignedErrorDoesNotSeeARigidMotionOfTheEstimate) {
  EXPECT_TRUE(rc::check([] {
    const Trajectory truth = RandomTrajectory(), estimate = Noisy(truth);
    const double before = AteRmse(truth, estimate);
    RC_ASSERT(std::abs(AteRmse(truth, Moved(RandomPose(50), estimate)) - before) < 1e-9);
    RC_ASSERT(std::abs(AteRmse(Moved(RandomPose(50), truth), estimate) - before) < 1e-9);
  }));
}

TEST(ScoreLaws, RelativeErrorNeedsNoAlignment) {
  EXPECT_TRUE(rc::check([] {
    const Trajectory truth = RandomTrajectory(), estimate = Noisy(truth);
    const Trajectory moved = Moved(RandomPose(50), estimate);
    const auto rmse = [&](const Trajectory& t) {
      return *ScoreTrajectory(truth, t).scores.at("rpe_trans_rmse_m").value;
    };
    RC_ASSERT(std::abs(rmse(moved) - rmse(estimate)) < 1e-9);
  }));
}

TEST(ScoreLaws, SimilarityAlignmentUndoesAScale) {
  EXPECT_TRUE(rc::check([] {
    const Trajectory truth = RandomTrajectory();
    RC_PRE((truth[0].T_world_rig.translation() - truth[1].T_world_rig.translation()).norm() > 0.1);
    const double scale = Real(0.2, 5);
    Trajectory estimate = Moved(RandomPose(10), truth);
    for (StampedPose& pose : estimate) pose.T_world_rig.translation() *= scale;
    const TrajectoryScore score = ScoreTrajectory(
        truth, estimate,
        {.association = {}, .alignment = {.method = AlignmentMethod::kSim3}, .relative = {}});
    RC_ASSERT(*score.scores.at("ate_rmse_m").value < 1e-8);
    RC_ASSERT(std::abs(score.alignment.scale * scale - 1) < 1e-9);
  }));
}

TEST(ScoreLaws, AssociationIsOneToOneAndWithinItsBound) {
  EXPECT_TRUE(rc::check([] {
    const Trajectory truth = RandomTrajectory();
    Trajectory estimate;
    std::int64_t stamp = -20'000'000;
    while (stamp < truth.back().stamp_ns) {
      stamp += *rc::gen::inRange(1, 80) * 1'000'000LL;
      estimate.push_back({stamp, Eigen::Isometry3d::Identity()});
    }
    const AssociationOptions options{.rule = AssociationRule::kNearest};
    const std::int64_t bound = MaxDifferenceNs(truth, estimate, options);
    const auto pairs = Associate(truth, estimate, options);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      RC_ASSERT(std::abs(truth[pairs[i].truth].stamp_ns - estimate[pairs[i].estimate].stamp_ns) <=
                bound);
      if (i == 0) continue;
      RC_ASSERT(pairs[i].truth > pairs[i - 1].truth);
      RC_ASSERT(pairs[i].estimate > pairs[i - 1].estimate);
    }
  }));
}

TEST(ScoreLaws, AssociationIsThatOfTheSortedListOfAllPairs) {
  EXPECT_TRUE(rc::check([] {
    const Trajectory truth = RandomStamps(), estimate = RandomStamps();
    const std::int64_t bound_ns = *rc::gen::inRange(0, 120) * 1'000'000LL;
    RC_ASSERT(Associate(truth, estimate, {.max_difference_ns = bound_ns}) ==
              PairsOfAll(truth, estimate, bound_ns, false));
    // Strict: one nanosecond more takes the bound in.
    RC_ASSERT(Associate(truth, estimate,
                        {.rule = AssociationRule::kTum, .max_difference_ns = bound_ns + 1}) ==
              PairsOfAll(truth, estimate, bound_ns, true));
  }));
}

/// As many pairs as there are would be 25 GB of candidates.
TEST(ScoreLaws, AssociationKeepsNoListOfAllPairs) {
  Trajectory dense;
  for (int i = 0; i < 40'000; ++i) dense.push_back({i * 1000LL, Eigen::Isometry3d::Identity()});
  EXPECT_EQ(Associate(dense, dense, {.max_difference_ns = 1'000'000'000'000}).size(), dense.size());
}

TEST(ScoreLaws, StampsFartherApartThanANumberReachesAreNoPair) {
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  Trajectory ends{{kFirst, Eigen::Isometry3d::Identity()}, {kLast, Eigen::Isometry3d::Identity()}};
  for (const auto rule :
       {AssociationRule::kNearest, AssociationRule::kTum, AssociationRule::kEvo}) {
    const auto pairs = Associate(ends, ends, {.rule = rule, .max_difference_ns = 1'000'000});
    EXPECT_EQ(pairs, (std::vector<PosePair>{{0, 0}, {1, 1}}));
    EXPECT_TRUE(Associate(ends, ends, {.rule = rule, .max_difference_ns = -1}).empty());
  }
}

TEST(ScoreLaws, ATruthOfAnyDensityGivesThePosesOfACameraEvosBound) {
  EXPECT_TRUE(rc::check([] {
    const auto every = [](std::int64_t step_ns) {
      Trajectory poses;
      for (int i = 0; i < 50; ++i) poses.push_back({i * step_ns, Eigen::Isometry3d::Identity()});
      return poses;
    };
    const std::int64_t camera_ns = *rc::gen::inRange(20, 200) * 1'000'000LL;
    const std::int64_t other_ns = *rc::gen::inRange(1, 200) * 1'000'000LL;
    const Trajectory camera = every(camera_ns), other = every(other_ns);
    const std::int64_t bound = MaxDifferenceNs(other, camera, {});
    RC_ASSERT(bound == MaxDifferenceNs(camera, other, {}));
    RC_ASSERT(bound == std::max<std::int64_t>(10'000'000, std::min(camera_ns, other_ns) / 2));
    RC_ASSERT(MaxDifferenceNs(other, other, {}) == other_ns / 2);
  }));
}

/// Whatever is missing on either side and however wide the bound: no pair crosses another.
TEST(ScoreLaws, AssociationNeverCrossesWhateverIsMissing) {
  EXPECT_TRUE(rc::check([] {
    Trajectory truth, estimate;
    for (int i = 0; i < 40; ++i) {
      const StampedPose pose{i * 10'000'000LL, RandomPose(5)};
      if (*rc::gen::inRange(0, 5) > 0) truth.push_back(pose);
      if (*rc::gen::inRange(0, 5) > 0) estimate.push_back(pose);
    }
    const AssociationOptions wide{.max_difference_ns = 25'000'000};
    const auto pairs = Associate(truth, estimate, wide);
    for (std::size_t i = 1; i < pairs.size(); ++i) {
      RC_ASSERT(pairs[i].truth > pairs[i - 1].truth);
      RC_ASSERT(pairs[i].estimate > pairs[i - 1].estimate);
    }
  }));
}

/// Of two files that lack a stamp each, the poses left over are no pair: the estimate is perfect.
TEST(ScoreLaws, APerfectEstimateHasNoErrorHoweverWideTheBound) {
  Trajectory truth, estimate;
  for (int i = 0; i < 100; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 0.5 * i, std::sin(0.2 * i), 0;
    if (i != 50) truth.push_back({i * 10'000'000LL, pose});
    if (i != 52) estimate.push_back({i * 10'000'000LL, pose});
  }
  for (const std::int64_t bound_ns : {5'000'000, 25'000'000}) {
    ScoreOptions options;
    options.association.max_difference_ns = bound_ns;
    const TrajectoryScore score = ScoreTrajectory(truth, estimate, options);
    EXPECT_EQ(score.pairs.size(), 98u);
    EXPECT_LT(*score.scores.at("ate_max_m").value, 1e-9) << bound_ns;
  }
  // The TUM scripts do pair them, and a figure of theirs can be had.
  const auto tum =
      Associate(truth, estimate, {.rule = AssociationRule::kTum, .max_difference_ns = 25'000'000});
  EXPECT_EQ(tum.size(), 99u);
}

TEST(ScoreLaws, OverlapIsSymmetricAndAtMostOne) {
  EXPECT_TRUE(rc::check([] {
    const auto box = [] { return cv::Rect2d(Real(0, 50), Real(0, 50), Real(1, 50), Real(1, 50)); };
    const cv::Rect2d a = box(), b = box();
    RC_ASSERT(Iou(a, b) == Iou(b, a));
    RC_ASSERT(Iou(a, b) >= 0 && Iou(a, b) <= 1);
    RC_ASSERT(std::abs(Iou(a, a) - 1) < 1e-12);
  }));
}

TEST(FrameMismatchTest, AConstantTurnOfTheRigIsToldInWords) {
  Trajectory truth, estimate;
  for (int i = 0; i < 60; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 3 * std::cos(0.1 * i), 2 * std::sin(0.1 * i), 0.2 * std::sin(0.3 * i);
    pose.linear() = Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    truth.push_back({i * 50'000'000LL, pose});
    pose.linear() =
        pose.linear() * Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
    estimate.push_back({i * 50'000'000LL, pose});
  }
  const TrajectoryScore score = ScoreTrajectory(truth, estimate);
  ASSERT_EQ(score.notes.size(), 1u);
  EXPECT_NE(score.notes[0].find("off by the same 90.0 degrees"), std::string::npos);
  EXPECT_TRUE(ScoreTrajectory(truth, truth).notes.empty());
}

TEST(FrameMismatchTest, AStraightDriveSaysNothingOfTheTurnAboutItself) {
  Trajectory truth, estimate;
  for (int i = 0; i < 200; ++i) {
    const double sway_m = 0.005 * std::sin(0.05 * i);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 0.08 * i, sway_m, 0.85;
    truth.push_back({i * 50'000'000LL, pose});
    pose.translation().z() += 0.6 * sway_m;  // which a turn by 31 degrees about the way explains
    estimate.push_back({i * 50'000'000LL, pose});
  }
  const TrajectoryScore score = ScoreTrajectory(truth, estimate);
  ASSERT_TRUE(score.alignment.rotation_determined);
  EXPECT_GT(RotationAngleDeg(score.alignment.T_truth_estimate.linear()), 20);
  EXPECT_TRUE(score.notes.empty()) << score.notes.front();
}

TEST(CoverageTest, LostFramesCountAsFailures) {
  RunResult run;
  for (int i = 0; i < 100; ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 0.1 * i, 0.01 * (i % 7), std::sin(0.2 * i);
    FrameEstimate estimate;
    estimate.id = i;
    estimate.stamp_ns = i * 50'000'000LL;
    if (i < 40 || i >= 60) {
      estimate.T_world_rig = pose;
      run.trajectory.live.push_back({estimate.stamp_ns, pose});
    }
    run.truth.push_back({estimate.stamp_ns, pose});
    run.facts.push_back({});
    run.estimates.push_back(estimate);
  }
  run.trajectory.final = run.trajectory.live;
  const Scorecard scores = ScoreRun(run).scores;
  EXPECT_DOUBLE_EQ(*scores.at("coverage").value, 0.8);
  EXPECT_DOUBLE_EQ(*scores.at("times_lost").value, 1);
  EXPECT_DOUBLE_EQ(*scores.at("recovery_max_s").value, 1.0);
  EXPECT_LT(*scores.at("error_all_p50_m").value, 1e-9);
  EXPECT_FALSE(scores.at("error_all_p95_m").value.has_value());
  EXPECT_EQ(scores.at("error_all_p95_m").absent, "lost in more than 5 % of the frames");
}

TEST(MaskTest, CountsAreThoseOfAHandMadePicture) {
  cv::Mat1b left(100, 100, static_cast<unsigned char>(128));
  FrameTruth truth;
  truth.dynamic = cv::Mat1b(100, 100, static_cast<unsigned char>(0));
  truth.instance = cv::Mat1w(100, 100, static_cast<unsigned short>(0));
  truth.dynamic(cv::Rect(10, 10, 20, 20)) = 255;  // one mover, found
  truth.instance(cv::Rect(10, 10, 20, 20)) = 3;
  truth.dynamic(cv::Rect(60, 60, 20, 20)) = 255;  // another, missed
  truth.instance(cv::Rect(60, 60, 20, 20)) = 4;
  DynamicRegions regions;
  regions.mask = cv::Mat1b(100, 100, static_cast<unsigned char>(0));
  regions.mask(cv::Rect(10, 10, 20, 30)) = 255;  // the first, too tall
  regions.mask(cv::Rect(60, 5, 20, 20)) = 255;   // nothing moves here
  const MaskFacts facts = CompareMasks(left, truth, regions);
  EXPECT_EQ(facts.true_positives, 400);
  EXPECT_EQ(facts.false_positives, 200 + 400);
  EXPECT_EQ(facts.false_negatives, 400);
  EXPECT_EQ(facts.objects_found, 1);
  EXPECT_EQ(facts.objects_missed, 1);
  EXPECT_EQ(facts.objects_invented, 1);
  EXPECT_DOUBLE_EQ(facts.iou_sum, 400.0 / 600.0);
}

TEST(MaskTest, TruthItselfAsAMaskInventsAndMissesNothing) {
  const cv::Mat1b left(200, 300, static_cast<unsigned char>(128));
  FrameTruth truth;
  truth.dynamic = cv::Mat1b(200, 300, static_cast<unsigned char>(0));
  truth.instance = cv::Mat1w(200, 300, static_cast<unsigned short>(0));
  const auto put = [&](const cv::Rect& where, int instance) {
    truth.dynamic(where) = 255;
    truth.instance(where) = static_cast<unsigned short>(instance);
  };
  put({20, 20, 30, 100}, 3);  // a person
  put({60, 20, 8, 100}, 3);   // and the rest of them beyond a post
  put({200, 20, 8, 8}, 4);    // too small to be asked for
  DynamicRegions regions;
  regions.mask = truth.dynamic.clone();
  const MaskFacts facts = CompareMasks(left, truth, regions);
  EXPECT_EQ(facts.objects_found, 1);
  EXPECT_EQ(facts.objects_invented, 0);
  EXPECT_EQ(facts.objects_missed, 0);
}

/// Two people of 800 pixels (1.3 % of the image) who touch, one of them walking, and what a system
/// rejects of them.
class TwoWhoTouch : public testing::Test {
 protected:
  TwoWhoTouch() {
    truth_.dynamic = cv::Mat1b(200, 300, static_cast<unsigned char>(0));
    truth_.instance = cv::Mat1w(200, 300, static_cast<unsigned short>(0));
    Put({100, 50, 20, 40}, 3, 1.2);
    Put({120, 50, 20, 40}, 4, 0.1);
  }

  void Put(const cv::Rect& where, int instance, double speed_mps) {
    truth_.dynamic(where) = 255;
    truth_.instance(where) = static_cast<unsigned short>(instance);
    ObjectTruth object;
    object.instance = instance;
    object.velocity_mps = Eigen::Vector3d(speed_mps, 0, 0);
    truth_.objects.push_back(object);
  }

  Scorecard Reject(const std::vector<cv::Rect>& where) const {
    DynamicRegions regions;
    regions.mask = cv::Mat1b(200, 300, static_cast<unsigned char>(0));
    for (const cv::Rect& rect : where) regions.mask(rect) = 255;
    RunResult run;
    run.facts.emplace_back().mask =
        CompareMasks(cv::Mat1b(200, 300, static_cast<unsigned char>(128)), truth_, regions);
    return ScoreMasks(run);
  }

  FrameTruth truth_;
};

TEST_F(TwoWhoTouch, AreCoveredByOneRegionThoughItsRectangleFitsOneAlone) {
  const Scorecard scores = Reject({{100, 50, 40, 40}});
  EXPECT_DOUBLE_EQ(*scores.at("object_recall").value, 0.5);
  EXPECT_DOUBLE_EQ(*scores.at("object_covered").value, 1);
  EXPECT_DOUBLE_EQ(*scores.at("object_covered_large").value, 1);
  EXPECT_DOUBLE_EQ(*scores.at("object_precision").value, 1);
}

TEST_F(TwoWhoTouch, KeepTheirInstancesForThoseWhoFollowThemOverFrames) {
  const MaskFacts facts =
      CompareMasks(cv::Mat1b(200, 300, static_cast<unsigned char>(128)), truth_, {});
  ASSERT_EQ(facts.objects.size(), 2u);
  EXPECT_EQ(facts.objects[0].instance, 3);
  EXPECT_EQ(facts.objects[1].instance, 4);
  EXPECT_TRUE(IsLargeMover(facts.objects[0]) && !IsSlowMover(facts.objects[0]));
  EXPECT_TRUE(IsSlowMover(facts.objects[1]) && !IsLargeMover(facts.objects[1]));
}

TEST_F(TwoWhoTouch, CountAmongTheLargeMoversOnlyOnTheirWay) {
  const Scorecard scores = Reject({{100, 50, 20, 40}});
  EXPECT_DOUBLE_EQ(*scores.at("object_recall").value, 0.5);
  EXPECT_DOUBLE_EQ(*scores.at("object_covered").value, 0.5);
  EXPECT_DOUBLE_EQ(*scores.at("object_recall_large").value, 1);
  EXPECT_EQ(scores.at("object_recall_large").n, 1u);
}

TEST_F(TwoWhoTouch, RegionsBelowOnePercentOfTheImageAreNotLarge) {
  const cv::Rect walker(100, 50, 20, 40), speck(10, 10, 20, 20), wall(200, 100, 30, 30);
  EXPECT_DOUBLE_EQ(*Reject({walker, speck}).at("object_precision").value, 0.5);
  EXPECT_DOUBLE_EQ(*Reject({walker, speck}).at("object_precision_large").value, 1);
  EXPECT_DOUBLE_EQ(*Reject({walker, wall}).at("object_precision_large").value, 0.5);
}

TEST_F(TwoWhoTouch, ALargeRegionThatCoversAMoverIsWideAndNotAstray) {
  const Scorecard scores = Reject({{100, 50, 20, 150}});
  EXPECT_DOUBLE_EQ(*scores.at("object_precision").value, 0);
  EXPECT_DOUBLE_EQ(*scores.at("object_precision_large").value, 1);
}

}  // namespace
}  // namespace aisle
