#include "harness/score/score_names.h"

#include <gtest/gtest.h>

#include <set>

#include "harness/score/drive_scores.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

/// A run with a bit of everything: masks of large and slow movers, stages, features.
RunResult BusyRun() {
  RunResult run;
  run.peak_rss_mib = 10;
  for (int i = 0; i < 60; ++i) {
    StampedPose pose;
    pose.stamp_ns = std::int64_t{i} * 50'000'000;
    pose.T_world_rig.translation() = Eigen::Vector3d(0.1 * i, 0.01 * (i % 3), 0);
    pose.T_world_rig.linear() =
        Eigen::AngleAxisd(0.02 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();  // 23 deg/s
    run.truth.push_back(pose);
    pose.T_world_rig.translation().y() += 0.01 * (i % 2);
    run.trajectory.final.push_back(pose);
    run.trajectory.live.push_back(pose);
    FrameFacts facts;
    facts.stamp_ns = pose.stamp_ns;
    facts.T_world_rig = pose.T_world_rig;
    facts.features = 100;
    facts.difficulty = {.static_texture_share = 0.5, .flow_px = 1, .blur_px = 1, .parallax_px = 1};
    MaskFacts mask;
    mask.true_positives = 10;
    mask.objects_found = 2;
    for (const double speed : {0.1, 1.0, 2.0}) {
      mask.objects.push_back({.instance = static_cast<int>(10 * speed),
                              .object_class = "person",
                              .pixels = 30000,
                              .share = 0.1,
                              .distance_m = 4,
                              .speed_mps = speed,
                              .found = i > 3,
                              .rejected = i > 3 ? 1.0 : 0.0});
    }
    facts.mask = mask;
    run.facts.push_back(facts);
    FrameEstimate estimate;
    estimate.stamp_ns = pose.stamp_ns;
    estimate.state = TrackingState::kTracking;
    estimate.T_world_rig = pose.T_world_rig;
    estimate.stage_ms = {{"extract", 1}, {"dynamic", 2}};
    run.estimates.push_back(estimate);
  }
  return run;
}

/// Every score there is, closed drives' among them.
Scorecard BusyScores() {
  Scorecard scores = ScoreRun(BusyRun()).scores;
  scores.merge(ScoreDrive(DriveLog{}));
  return scores;
}

TEST(ScoreNamesTest, EveryScoreOfARunHasAName) {
  const Scorecard scores = BusyScores();
  ASSERT_GT(scores.size(), 60u);
  for (const auto& [name, score] : scores) EXPECT_TRUE(IsScoreName(name)) << name;
}

TEST(ScoreNamesTest, EveryNameIsAScoreOfSomeRun) {
  const Scorecard scores = BusyScores();
  for (const ScoreDescription& description : ScoreNames()) {
    if (description.name == "dynamic_penalty") continue;  // of two runs
    const std::size_t star = description.name.find('*');
    const std::string head = description.name.substr(0, star);
    const bool any = std::any_of(scores.begin(), scores.end(), [&](const auto& entry) {
      return star == std::string::npos ? entry.first == head : entry.first.starts_with(head);
    });
    EXPECT_TRUE(any) << description.name;
    if (any && star == std::string::npos) {
      EXPECT_EQ(scores.at(head).unit, description.unit) << description.name;
    }
  }
}

TEST(ScoreNamesTest, NoOtherNameIsOne) {
  for (const char* bad : {"", "ate_rmse", "ate_rmse_mm", "ms__mean", "ms_mean", "object_recall_"}) {
    EXPECT_FALSE(IsScoreName(bad)) << bad;
  }
  std::set<std::string> names;
  for (const ScoreDescription& one : ScoreNames()) EXPECT_TRUE(names.insert(one.name).second);
}

}  // namespace
}  // namespace aisle
