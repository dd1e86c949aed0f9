#include "harness/score/coverage.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

/// A drive along x at 1 m/s: poses every `step_ms`, those in [from, to) seconds left out.
Trajectory Drive(int step_ms, double end_s, double from_s = 0, double to_s = 0, double off_m = 0) {
  Trajectory poses;
  for (int ms = 0; ms <= 1000 * end_s; ms += step_ms) {
    const double s = ms * 1e-3;
    if (s >= from_s && s < to_s) continue;
    StampedPose pose{ms * std::int64_t{1'000'000}};
    pose.T_world_rig.translation() << s, std::sin(s), off_m * std::sin(50 * s);
    poses.push_back(pose);
  }
  return poses;
}

Scorecard Cover(const Trajectory& truth, const Trajectory& estimate) {
  const TrajectoryScore score = ScoreTrajectory(truth, estimate, {});
  Scorecard scores;
  AddCoverage(ErrorsOverFrames(truth, score, FrameIntervalNs(truth, estimate)), "se3", &scores);
  return scores;
}

TEST(CoverageTest, LostFramesCountAsFailures) {
  const Scorecard scores = Cover(Drive(50, 20), Drive(50, 20, 10, 14, 0.1));
  EXPECT_NEAR(*scores.at("coverage").value, 1 - 80.0 / 401, 1e-12);
  EXPECT_EQ(*scores.at("times_lost").value, 1);
  EXPECT_NEAR(*scores.at("recovery_max_s").value, 4, 1e-9);
  EXPECT_TRUE(scores.at("error_all_p50_m").value);
  EXPECT_FALSE(scores.at("error_all_p95_m").value);
  EXPECT_EQ(scores.at("error_all_p95_m").absent, "lost in more than 5 % of the frames");
}

TEST(CoverageTest, GivingUpEarlyIsNoWayToABetterScore) {
  const Trajectory truth = Drive(50, 20), whole = Drive(50, 20, 0, 0, 0.1);
  Trajectory early(whole.begin(), whole.begin() + 100);
  EXPECT_TRUE(Cover(truth, whole).at("error_all_p50_m").value);
  EXPECT_FALSE(Cover(truth, early).at("error_all_p50_m").value);
  EXPECT_EQ(Cover(truth, early).at("recovery_max_s").absent, "did not recover before the end");
}

TEST(CoverageTest, ADenserTruthDoesNotMakeFramesOutOfNothing) {
  const Trajectory estimate = Drive(50, 20);
  EXPECT_EQ(*Cover(Drive(5, 20), estimate).at("coverage").value, 1);
  EXPECT_NEAR(*Cover(Drive(5, 20), Drive(50, 20, 10, 15)).at("coverage").value, 0.75, 0.005);
}

}  // namespace
}  // namespace aisle
