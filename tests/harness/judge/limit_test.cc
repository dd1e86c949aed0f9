#include "harness/judge/limit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

const Limit kTight{
    .score = "ate_rmse_m", .scene = "", .twin = "live", .system = "oracle", .min = {}, .max = 0.02};

TEST(LimitTest, AScoreThatIsAbsentFails) {
  RunRecord run;
  run.spec = {
      .scene = "s", .scene_file = "", .twin = "live", .system = BuiltIn("oracle"), .seed = 1};
  run.scores["ate_rmse_m"].absent = "no poses";
  const auto verdicts = Judge({run}, {kTight});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_FALSE(verdicts[0].passed);
  EXPECT_EQ(verdicts[0].why, "seed 1 has no value: no poses");
}

TEST(LimitTest, TheMedianOverSeedsIsHeldAgainstTheBound) {
  std::vector<RunRecord> runs(3);
  const double values[] = {0.01, 0.5, 0.015};
  for (std::size_t i = 0; i < 3; ++i) {
    runs[i].spec = {
        .scene = "s", .scene_file = "", .twin = "live", .system = BuiltIn("oracle"), .seed = i};
    runs[i].scores["ate_rmse_m"] = {
        .value = values[i], .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
  }
  const auto verdicts = Judge(runs, {kTight});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_TRUE(verdicts[0].passed);
  EXPECT_DOUBLE_EQ(*verdicts[0].value, 0.015);
}

/// Nine drives, of which those of the last seeds touch a rack and miss their goal.
std::vector<RunRecord> Drives(std::uint64_t bad) {
  std::vector<RunRecord> runs;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    RunRecord& run = runs.emplace_back();
    run.spec = {
        .scene = "s", .scene_file = "", .twin = "live", .system = BuiltIn("robust"), .seed = seed};
    const bool is_bad = seed > 9 - bad;
    run.scores["goal_reached"] = {is_bad ? 0.0 : 1.0, "1", "", 1, ""};
    run.scores["collisions_static"] = {is_bad ? static_cast<double>(seed) : 0, "1", "", 1, ""};
    run.scores["docking_error_m"] = {0.001 * static_cast<double>(seed), "m", "", 1, ""};
  }
  return runs;
}

Verdict Held(const std::vector<RunRecord>& runs, const Limit& limit) {
  const std::vector<Verdict> verdicts = JudgeLimits(runs, {limit});
  EXPECT_EQ(verdicts.size(), 1u);
  return verdicts.at(0);
}

TEST(LimitTest, AShareHoldsEachSeedWhereTheMedianSeesNothing) {
  Limit untouched{.score = "collisions_static", .max = 0},
      reached{.score = "goal_reached", .min = 1};
  EXPECT_TRUE(Held(Drives(4), untouched).passed);
  EXPECT_TRUE(Held(Drives(4), reached).passed);
  untouched.share = reached.share = 1;
  const Verdict touched = Held(Drives(4), untouched), missed = Held(Drives(4), reached);
  EXPECT_FALSE(touched.passed);
  EXPECT_EQ(touched.why, "5 of 9 seeds are at most 0, needed are 9; the worst is 9 of seed 9");
  EXPECT_EQ(touched.value, 9);
  EXPECT_FALSE(missed.passed);
  EXPECT_EQ(missed.why, "5 of 9 seeds are at least 1, needed are 9; the worst is 0 of seed 6");
  EXPECT_FALSE(Held(Drives(1), untouched).passed);
  EXPECT_TRUE(Held(Drives(0), untouched).passed);
  EXPECT_TRUE(Held(Drives(0), reached).passed);
}

TEST(LimitTest, AShareBelowOneLetsSoManySeedsGo) {
  Limit docks{.score = "docking_error_m", .max = 0.0075, .share = 7.0 / 9};
  const Verdict held = Held(Drives(0), docks);
  EXPECT_TRUE(held.passed) << held.why;
  EXPECT_EQ(held.why,
            "7 of 9 seeds are at most 0.0075, needed are 7; the worst is 0.009 m of seed 9");
  docks.share = 0.8;
  EXPECT_FALSE(Held(Drives(0), docks).passed);
  docks.min = 0.0015;  // seed 1 is below: six are within, and seed 9 is farthest off
  EXPECT_EQ(Held(Drives(0), docks).why,
            "6 of 9 seeds are at most 0.0075 and at least 0.0015, needed are 8; the worst is 0.009 "
            "m of seed 9");
}

TEST(LimitTest, ASeedWithoutItsScoreDoesNotHoldItsShare) {
  std::vector<RunRecord> runs = Drives(0);
  runs[4].scores.erase("goal_reached");
  runs[4].status_why = "killed at the time limit";
  Limit reached{.score = "goal_reached", .min = 1, .share = 1};
  const Verdict verdict = Held(runs, reached);
  EXPECT_FALSE(verdict.passed);
  EXPECT_EQ(verdict.why,
            "8 of 9 seeds are at least 1, needed are 9; the worst is 1 of seed 1; seed 5 has no "
            "value: killed at the time limit");
  reached.share = 0.88;
  EXPECT_TRUE(Held(runs, reached).passed);
}

/// A seed that is driven twice holds its bound where both drives do.
TEST(LimitTest, ASharesSeedsHoldInAllTheirRepeats) {
  std::vector<RunRecord> runs = Drives(0);
  runs.push_back(runs[2]);
  runs.back().spec.repeat = 2;
  *runs.back().scores["collisions_static"].value = 1;
  EXPECT_EQ(Held(runs, {.score = "collisions_static", .max = 0, .share = 1}).why,
            "8 of 9 seeds are at most 0, needed are 9; the worst is 1 of seed 3");
}

/// A robust drive with this docking error, the `repeat`th of its seed.
RunRecord Docked(std::uint64_t seed, int repeat, double error_m) {
  RunRecord run;
  run.spec = {.scene = "s",
              .scene_file = "",
              .twin = "live",
              .system = BuiltIn("robust"),
              .seed = seed,
              .repeat = repeat};
  run.scores["docking_error_m"] = {error_m, "m", "", 1, ""};
  return run;
}

TEST(LimitTest, TheBoundThatIsBrokenIsTheVerdictsLimit) {
  Limit within{.score = "docking_error_m", .min = 0.01, .max = 0.1};
  for (const std::optional<double> share : {std::optional<double>(), std::optional<double>(1)}) {
    within.share = share;
    const Verdict above = Held({Docked(1, 1, 0.5)}, within),
                  below = Held({Docked(1, 1, 0.001)}, within);
    EXPECT_FALSE(above.passed);
    EXPECT_EQ(above.limit, within.max);
    EXPECT_FALSE(below.passed);
    EXPECT_EQ(below.limit, within.min);
  }
}

TEST(LimitTest, OfTwoBoundsThatHoldTheNearerIsTheVerdictsLimit) {
  const Limit within{.score = "docking_error_m", .min = 0.01, .max = 0.1};
  EXPECT_EQ(Held({Docked(1, 1, 0.02)}, within).limit, within.min);
  EXPECT_EQ(Held({Docked(1, 1, 0.09)}, within).limit, within.max);
}

TEST(LimitTest, ASeedCountsOnceHoweverOftenItIsDriven) {
  const Limit docks{.score = "docking_error_m", .max = 0.1};
  std::vector<RunRecord> runs;
  for (int repeat = 1; repeat <= 5; ++repeat) runs.push_back(Docked(1, repeat, 0.5));
  EXPECT_THAT(Held(runs, docks).why, testing::StartsWith("median of 5 repeats 0.5 m"));
  runs.push_back(Docked(2, 1, 0.02));
  runs.push_back(Docked(3, 1, 0.04));
  const Verdict verdict = Held(runs, docks);
  EXPECT_EQ(verdict.why, "median of 3 seeds 0.04 m is at most 0.1");
  EXPECT_TRUE(verdict.passed);
  EXPECT_THAT(Held({Docked(1, 1, 0.02)}, docks).why, testing::StartsWith("value 0.02 m"));
}

TEST(LimitTest, ALimitThatMatchesNothingFails) {
  const auto verdicts = Judge({}, {kTight});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_FALSE(verdicts[0].passed);
}

TEST(LimitTest, ACrashFailsWithoutAnyLimit) {
  RunRecord run;
  run.spec.system = BuiltIn("oracle");
  run.status = RunStatus::kCrashed;
  run.status_why = "signal 11";
  const auto verdicts = Judge({run}, {});
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].why, "crashed: signal 11");
}

}  // namespace
}  // namespace aisle
