#include "harness/score/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/support/arbitrary.h"

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

TrajectoryScore ScoreOfFiles(const Trajectory& truth, const Trajectory& estimate,
                             double rate_hz = 0) {
  TrajectoryScore score = ScoreTrajectory(truth, estimate, {});
  AddCoverageOfFiles(truth, estimate, {}, rate_hz, &score);
  return score;
}
Scorecard Cover(const Trajectory& truth, const Trajectory& estimate, double rate_hz = 0) {
  return ScoreOfFiles(truth, estimate, rate_hz).scores;
}
double Value(const Scorecard& scores, const char* name) { return *scores.at(name).value; }

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

TEST(CoverageTest, WhereMotionCaptureSawNothingTheSystemIsNotLost) {
  const TrajectoryScore score = ScoreOfFiles(Drive(3, 40, 10, 22), Drive(32, 40));
  EXPECT_EQ(Value(score.scores, "coverage"), 1);
  EXPECT_EQ(Value(score.scores, "times_lost"), 0);
  EXPECT_EQ(score.scores.at("recovery_max_s").absent, "never lost");
  EXPECT_LT(Value(score.scores, "error_all_p95_m"), 0.01);
  // Twelve seconds of 32 ms, but for the rims within the bound of 10 ms.
  ASSERT_EQ(score.notes.size(), 1u);
  EXPECT_THAT(score.notes[0], testing::MatchesRegex("37[456] of 1251 poses have no truth of their "
                                                    "own within 10 ms.*--max-difference.*"));
}

/// Public truth has holes, and what it lacks must not look like a loss of the system.
TEST(CoverageTest, NoRowThatTruthLacksChangesWhatIsLost) {
  EXPECT_TRUE(rc::check([] {
    const double hole_s = AnyOf(0, 2) * AnyNumberIn(0.2, 5);
    const Trajectory estimate = Drive(50, 20, 10, 10 + hole_s), whole = Drive(5, 20);
    Trajectory truth;
    const double from_s = AnyNumberIn(0.1, 15), to_s = from_s + AnyNumberIn(0, 4);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const double s = static_cast<double>(whole[i].stamp_ns) * 1e-9;
      const bool is_end = i == 0 || i + 1 == whole.size();
      if (is_end || s < from_s || s > to_s) truth.push_back(whole[i]);
    }
    for (const char* name : {"coverage", "times_lost"}) {
      RC_ASSERT(Value(Cover(truth, estimate), name) == Value(Cover(whole, estimate), name));
    }
  }));
}

TEST(CoverageTest, WithTheCamerasRateEveryPoseThatIsMissingIsALostFrame) {
  EXPECT_TRUE(rc::check([] {
    const int truth_ms = AnyOf(1, 3) == 1 ? 5 : 50;
    const Trajectory whole = Drive(50, 10);
    Trajectory estimate;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      if (i == 100 || AnyOf(0, 4) > 0) estimate.push_back(whole[i]);
    }
    const Scorecard scores = Cover(Drive(truth_ms, 10), estimate, 20);
    RC_ASSERT(scores.at("coverage").n == whole.size());
    RC_ASSERT(std::abs(Value(scores, "coverage") - static_cast<double>(estimate.size()) /
                                                       static_cast<double>(whole.size())) < 1e-12);
  }));
}

TEST(CoverageTest, APictureThatTheCameraDroppedIsNoLoss) {
  const Trajectory truth = Drive(5, 20), estimate = Drive(50, 20, 10, 10.1);
  EXPECT_EQ(Value(Cover(truth, estimate), "times_lost"), 0);
  EXPECT_EQ(Value(Cover(truth, estimate, 20), "times_lost"), 1) << "its rate tells";
  EXPECT_EQ(Value(Cover(Drive(50, 20), estimate), "times_lost"), 1) << "and rows of every frame";
}

TEST(CoverageTest, AnEstimateBeyondTheCamerasRateCountsOnceAFrame) {
  const Scorecard scores = Cover(Drive(5, 20), Drive(5, 20, 10, 15), 20);
  EXPECT_EQ(scores.at("coverage").n, 401u);
  EXPECT_NEAR(Value(scores, "coverage"), 0.75, 0.005);
}

TEST(CoverageTest, EndsThatTheEstimateLacksAreToldInWords) {
  const Trajectory truth = Drive(50, 3), all = Drive(50, 3);
  const TrajectoryScore early = ScoreOfFiles(truth, Trajectory(all.begin(), all.begin() + 40));
  ASSERT_EQ(early.notes.size(), 1u);
  EXPECT_THAT(early.notes[0], testing::HasSubstr("the estimate ends 1.05 s before the truth: 21 "
                                                 "frames there count as lost"));
  const TrajectoryScore late =
      ScoreOfFiles(Drive(5, 3), Trajectory(all.begin() + 10, all.end() - 5));
  ASSERT_EQ(late.notes.size(), 1u);
  EXPECT_THAT(late.notes[0], testing::HasSubstr("begins 0.5 s after the truth and ends 0.25 s "
                                                "before the truth: 15 frames"));
  EXPECT_TRUE(ScoreOfFiles(truth, all).notes.empty());
}

TEST(CoverageTest, AStampThatIsOffByYearsIsNoDriveOfYears) {
  Trajectory estimate = Drive(50, 20);
  for (StampedPose& pose : estimate) pose.stamp_ns += 1'700'000'000'000'000'000;
  Trajectory truth = estimate;
  truth.front().stamp_ns = estimate[1].stamp_ns - 1;
  estimate.front().stamp_ns = 0;
  EXPECT_LT(Value(Cover(truth, estimate, 20), "coverage"), 0.01);
}

}  // namespace
}  // namespace aisle
