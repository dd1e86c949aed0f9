#include "harness/judge/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "harness/judge/gate.h"

namespace aisle {
namespace {

RunRecord MakeRecordOf(const std::string& system, std::uint64_t seed, double ate_m,
                       double coverage = 1) {
  RunRecord run;
  run.spec = {
      .scene = "s", .scene_file = "", .twin = "live", .system = BuiltIn(system), .seed = seed};
  run.scores["ate_rmse_m"] = {
      .value = ate_m, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
  run.scores["coverage"] = {.value = coverage, .unit = "1", .alignment = "", .n = 9, .absent = ""};
  return run;
}

/// Nine seeds around `level`, spread by a tenth.
Results Night(double level, std::uint64_t noise_seed, double coverage = 1) {
  std::mt19937_64 random(noise_seed);
  Results results;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    const double noise = static_cast<double>(random() % 2001) / 1000 - 1;
    results.runs.push_back(MakeRecordOf("oracle", seed, level * (1 + 0.1 * noise), coverage));
  }
  return results;
}

Change ChangeOf(const std::vector<Comparison>& comparisons, const std::string& score) {
  for (const Comparison& c : comparisons) {
    if (c.score == score) return c.change;
  }
  throw std::logic_error("no " + score);
}

TEST(CompareTest, AClearShiftIsWorseOneWayAndBetterTheOther) {
  const Results good = Night(0.02, 1), bad = Night(0.04, 2);
  EXPECT_EQ(ChangeOf(Compare(good, bad), "ate_rmse_m"), Change::kWorse);
  EXPECT_EQ(ChangeOf(Compare(bad, good), "ate_rmse_m"), Change::kBetter);
}

TEST(CompareTest, EqualNightsAreTheSame) {
  const auto comparisons = Compare(Night(0.02, 1), Night(0.02, 1));
  EXPECT_EQ(ChangeOf(comparisons, "ate_rmse_m"), Change::kSame);
  EXPECT_TRUE(comparisons.front().bit_equal);
}

TEST(CompareTest, OtherBitsOnAnotherProcessorAreNoAlarmButAClearShiftIs) {
  Results before = Night(0.02, 1), after = before, worse = Night(0.04, 2);
  for (RunRecord& run : after.runs) *run.scores["ate_rmse_m"].value *= 1.04;
  before.provenance.cpu = "one make";
  after.provenance.cpu = worse.provenance.cpu = "another";
  EXPECT_FALSE(SameProcessor(before, after));
  for (const Comparison& c : Compare(before, after)) {
    EXPECT_NE(c.change, Change::kWorse);
    EXPECT_EQ(c.why.find("another was one make") != std::string::npos, !c.bit_equal);
  }
  EXPECT_EQ(ChangeOf(Compare(before, worse), "ate_rmse_m"), Change::kWorse);
}

TEST(CompareTest, CoverageStandsFirstAndFallingCoverageIsWorse) {
  const auto comparisons = Compare(Night(0.02, 1, 1.0), Night(0.01, 2, 0.5));
  EXPECT_EQ(comparisons.front().score, "coverage");
  EXPECT_EQ(comparisons.front().change, Change::kWorse);
}

/// Nine closed drives, of which the first `touch` have touched something and missed their goal.
Results Drives(std::uint64_t touch, double docking_m) {
  Results night = Night(0.02, 1);
  for (RunRecord& run : night.runs) {
    const bool touched = run.spec.seed <= touch;
    const double apart = 1 + 0.01 * static_cast<double>(run.spec.seed);
    run.scores["goal_reached"] = {touched ? 0.0 : 1.0, "1", "", 1, ""};
    run.scores["collisions"] = {touched ? 1.0 : 0.0, "1", "", 1, ""};
    run.scores["docking_error_m"] = {docking_m * apart, "m", "", 1, ""};
  }
  return night;
}

TEST(CompareTest, VehiclesThatTouchSomethingOrDockWorseRaiseAnAlarm) {
  const Results good = Drives(0, 0.005);
  const auto some = Compare(good, Drives(3, 0.005));
  EXPECT_EQ(ChangeOf(some, "collisions"), Change::kUnstable);
  EXPECT_EQ(ChangeOf(some, "goal_reached"), Change::kUnstable);
  EXPECT_EQ(ChangeOf(some, "docking_error_m"), Change::kSame);
  const auto all = Compare(good, Drives(9, 0.05));
  EXPECT_EQ(ChangeOf(all, "collisions"), Change::kWorse);
  EXPECT_EQ(ChangeOf(all, "goal_reached"), Change::kWorse);
  EXPECT_EQ(ChangeOf(all, "docking_error_m"), Change::kWorse);
  EXPECT_EQ(ChangeOf(Compare(Drives(9, 0.05), good), "collisions"), Change::kBetter);
}

/// The seed with the largest error is not there to be compared: the others are as they were, and
/// one of them that breaks is seen beside its own past.
TEST(CompareTest, ASeedThatOneSideLacksIsLeftOutOfBoth) {
  const Results before = Night(0.02, 1);
  Results fewer = before;
  const auto ate = [](const RunRecord& run) { return *run.scores.at("ate_rmse_m").value; };
  std::erase_if(fewer.runs, [&](const RunRecord& run) {
    return std::all_of(before.runs.begin(), before.runs.end(),
                       [&](const RunRecord& other) { return ate(other) <= ate(run); });
  });
  ASSERT_EQ(fewer.runs.size(), 8u);
  for (const auto& [old_side, new_side] : {std::pair{before, fewer}, std::pair{fewer, before}}) {
    const Comparison same = Compare(old_side, new_side).at(1);
    EXPECT_EQ(same.score, "ate_rmse_m");
    EXPECT_TRUE(same.bit_equal && same.paired);
    EXPECT_EQ(same.old_n, 8u);
    EXPECT_EQ(same.left_out, 1u);
    EXPECT_THAT(same.why, testing::HasSubstr("ignored 1 seed that only one side has"));
  }
  *fewer.runs.at(3).scores["ate_rmse_m"].value *= 20;
  EXPECT_EQ(ChangeOf(Compare(before, fewer), "ate_rmse_m"), Change::kUnstable);
}

TEST(CompareTest, ThreeSeedsCannotTell) {
  Results before, after;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    before.runs.push_back(MakeRecordOf("oracle", seed, 0.02));
    after.runs.push_back(MakeRecordOf("oracle", seed, 0.2));
  }
  EXPECT_EQ(ChangeOf(Compare(before, after), "ate_rmse_m"), Change::kCannotTell);
}

/// Two nights of 25 cells of five scores, all from one log-normal distribution.
std::pair<Results, Results> UnchangedNights(std::uint64_t night, double sigma) {
  constexpr const char* kErrors[] = {"ate_rmse_m", "ate_live_rmse_m", "error_all_p95_m",
                                     "rpe_1s_trans_rmse_m", "rpe_1s_rot_rmse_deg"};
  std::mt19937_64 random(night + 1000);
  std::lognormal_distribution<double> spread(0, sigma);
  Results before, after;
  for (int cell = 0; cell < 25; ++cell) {
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
      for (Results* side : {&before, &after}) {
        RunRecord run = MakeRecordOf(fmt::format("x{}", cell), seed, 0);
        for (const char* error : kErrors) {
          run.scores[error] = {
              .value = 0.02 * spread(random), .unit = "m", .alignment = "", .n = 9, .absent = ""};
        }
        side->runs.push_back(std::move(run));
      }
    }
  }
  return {std::move(before), std::move(after)};
}

/// Alarms of any kind, and "better", which is as false. Ranks do not know the scatter: each has
/// nights of its own.
TEST(CompareTest, UnchangedCodeRaisesAFalseAlarmAtMostOnceInAHundredNights) {
  constexpr std::uint64_t kNights = 200;
  int alarms = 0, unstable = 0;
  for (std::uint64_t night = 0; night < kNights; ++night) {
    const double sigma = std::array{0.2, 0.35, 0.4, 0.5}[night % 4];
    const auto [before, after] = UnchangedNights(night, sigma);
    const auto comparisons = Compare(before, after);
    const auto any = [&](const auto& is_it) {
      return std::any_of(comparisons.begin(), comparisons.end(), is_it);
    };
    alarms +=
        any([](const Comparison& c) { return IsAlarm(c.change) || c.change == Change::kBetter; });
    unstable += any([](const Comparison& c) { return c.change == Change::kUnstable; });
  }
  EXPECT_LE(alarms, static_cast<int>(kNights / 100));
  EXPECT_EQ(unstable, 0);
}

/// In a whole night of wide scatter, a cell that hardly scattered and broke in four seeds is told.
TEST(CompareTest, AFewSeedsThatBreakAreToldAmongManyThatScatter) {
  auto [before, after] = UnchangedNights(1, 0.5);
  const Results calm = Night(0.02, 1);
  for (const RunRecord& run : calm.runs) {
    before.runs.push_back(run);
    after.runs.push_back(run);
    if (run.spec.seed % 2 == 0) *after.runs.back().scores["ate_rmse_m"].value *= 10;
  }
  for (const Comparison& c : Compare(before, after)) {
    const bool is_broken = c.system == "oracle" && c.score == "ate_rmse_m";
    EXPECT_EQ(c.change == Change::kUnstable, is_broken) << c.system << c.score << c.why;
  }
}

TEST(GateTest, WhatIsGoneFailsAndWhatIsWorseFails) {
  const Results baseline = Night(0.02, 1);
  const auto gone = GateVerdicts(baseline, {});
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_FALSE(gone[0].passed);
  int failed = 0;
  for (const Verdict& verdict : GateVerdicts(baseline, Night(0.04, 2))) failed += !verdict.passed;
  EXPECT_EQ(failed, 1);
  for (const Verdict& verdict : GateVerdicts(baseline, Night(0.02, 3))) {
    EXPECT_TRUE(verdict.passed) << verdict.name << verdict.why;
  }
}

/// The verdict on one score, which must be there.
Verdict On(const std::vector<Verdict>& verdicts, const std::string& part) {
  for (const Verdict& verdict : verdicts) {
    if (verdict.name.find(part) != std::string::npos) return verdict;
  }
  Verdict none;
  none.name = "no verdict on " + part;
  none.passed = true;
  return none;
}

TEST(GateTest, AScoreThatVanishedFailsAndSaysWhy) {
  const Results baseline = Night(0.02, 1);
  Results deleted = baseline, empty = baseline, partly = baseline;
  for (RunRecord& run : deleted.runs) run.scores.erase("ate_rmse_m");
  for (RunRecord& run : empty.runs) {
    run.scores["coverage"].value.reset();
    run.scores["coverage"].absent = "nobody asked";
  }
  partly.runs[3].scores["ate_rmse_m"].value.reset();
  const Verdict on_deleted = On(GateVerdicts(baseline, deleted), "ate_rmse_m");
  EXPECT_FALSE(on_deleted.passed) << on_deleted.name;
  EXPECT_NE(on_deleted.why.find("gone: nothing was 0.0"), std::string::npos) << on_deleted.why;
  EXPECT_FALSE(on_deleted.value);
  const Verdict on_empty = On(GateVerdicts(baseline, empty), "coverage");
  EXPECT_FALSE(on_empty.passed) << on_empty.name;
  EXPECT_NE(on_empty.why.find("seed 1: nobody asked"), std::string::npos) << on_empty.why;
  const Verdict on_partly = On(GateVerdicts(baseline, partly), "ate_rmse_m");
  EXPECT_FALSE(on_partly.passed) << on_partly.name;
  EXPECT_NE(on_partly.why.find("9 seeds had a value, 8 have one; seed 4"), std::string::npos);
  // What the baseline never had may stay away.
  EXPECT_TRUE(On(GateVerdicts(deleted, deleted), "ate_rmse_m").passed);
}

/// Nights of nine seeds whose runs were each repeated so often; in `lost` of the repeats of seed 4
/// tracking was reset.
Results Repeated(int repeats, int lost) {
  Results night;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    for (int repeat = 1; repeat <= repeats; ++repeat) {
      RunRecord run = MakeRecordOf("mine", seed, 0.02 + 0.001 * static_cast<double>(seed));
      run.spec.system = {.name = "mine", .external = ExternalSystem{}};
      run.spec.system.external->repeats = repeats;
      run.spec.repeat = repeat;
      if (seed == 4 && repeat <= lost) {
        run.scores["ate_rmse_m"].value.reset();
        run.scores["ate_rmse_m"].absent = "tracking was reset";
      }
      night.runs.push_back(std::move(run));
    }
  }
  return night;
}

/// The median of the others says nothing of a repeat that has no value any more.
TEST(GateTest, AScoreThatVanishedFromOneRepeatIsGone) {
  const Verdict lost = On(GateVerdicts(Repeated(5, 0), Repeated(5, 1)), "ate_rmse_m");
  EXPECT_FALSE(lost.passed) << lost.name;
  EXPECT_THAT(lost.why, testing::HasSubstr("seed 4: 4 of 5 repeats have a value, before 5 of 5; "
                                           "tracking was reset"));
  for (const auto& [before, now] : {std::pair(1, 1), std::pair(2, 1), std::pair(5, 5)}) {
    const Verdict same = On(GateVerdicts(Repeated(5, before), Repeated(5, now)), "ate_rmse_m");
    EXPECT_TRUE(same.passed) << before << now << same.name << same.why;
  }
  EXPECT_FALSE(On(GateVerdicts(Repeated(5, 1), Repeated(5, 2)), "ate_rmse_m").passed);
}

TEST(GateTest, FewerRepeatsByIntentionAreNotGoneAndMissingOrCrashedOnesAre) {
  const Results five = Repeated(5, 0);
  EXPECT_TRUE(On(GateVerdicts(five, Repeated(3, 0)), "ate_rmse_m").passed);
  EXPECT_TRUE(On(GateVerdicts(Repeated(3, 0), five), "ate_rmse_m").passed);
  EXPECT_FALSE(On(GateVerdicts(five, Repeated(3, 1)), "ate_rmse_m").passed);
  Results missing = five, crashed = five;
  missing.runs.pop_back();
  crashed.runs.back().scores.clear();
  crashed.runs.back().status = RunStatus::kCrashed;
  crashed.runs.back().status_why = "signal 11";
  const Verdict on_missing = On(GateVerdicts(five, missing), "ate_rmse_m");
  EXPECT_FALSE(on_missing.passed);
  EXPECT_THAT(on_missing.why, testing::HasSubstr("seed 9: 4 of 5 repeats have a value, before 5 of "
                                                 "5; a repeat is missing"));
  const Verdict on_crashed = On(GateVerdicts(five, crashed), "ate_rmse_m");
  EXPECT_FALSE(on_crashed.passed);
  EXPECT_THAT(on_crashed.why, testing::HasSubstr("signal 11"));
}

TEST(GateTest, SaysWhereSeedsAreTooFewToSeeAnything) {
  Results few = Night(0.02, 1);
  EXPECT_EQ(BlindFor(few), "");
  few.runs.resize(4);
  EXPECT_THAT(BlindFor(few),
              testing::HasSubstr("1 of 1 cells of the baseline have fewer than 5 seeds"));
}

TEST(GateTest, SeedsThatDidNotRunFail) {
  const Results baseline = Night(0.02, 1);
  Results fewer = baseline;
  fewer.runs.erase(fewer.runs.begin() + 2, fewer.runs.begin() + 4);
  const Verdict verdict = On(GateVerdicts(baseline, fewer), ": baseline");
  EXPECT_FALSE(verdict.passed) << verdict.name;
  EXPECT_EQ(verdict.why, "the baseline has seeds 3, 4, which the new run does not have");
}

TEST(GateTest, CellsThatTheBaselineLacksAreCountedAndFailNothing) {
  const Results baseline = Night(0.02, 1);
  Results night = baseline;
  night.runs.push_back(MakeRecordOf("new", 1, 0.02));
  EXPECT_EQ(On(GateVerdicts(baseline, night), kWithoutBaseline).why,
            "1 cell has no baseline and is held against nothing: s live new");
  EXPECT_TRUE(On(GateVerdicts(baseline, night), kWithoutBaseline).passed);
  EXPECT_THAT(On(GateVerdicts(baseline, baseline), kWithoutBaseline).name,
              testing::HasSubstr("no verdict on"));
}

TEST(GateTest, AFewSeedsThatBreakAreUnstable) {
  const Results baseline = Night(0.02, 1);
  Results lost = baseline, mixed = baseline, loose = baseline;
  lost.runs[5].scores["coverage"].value = 0.3;
  for (const std::size_t i : {0u, 2u, 4u, 6u}) *mixed.runs[i].scores["ate_rmse_m"].value *= 10;
  for (const std::size_t i : {0u, 2u, 4u, 6u}) *loose.runs[i].scores["ate_rmse_m"].value *= 1.4;
  EXPECT_EQ(ChangeOf(Compare(baseline, lost), "coverage"), Change::kUnstable);
  EXPECT_EQ(ChangeOf(Compare(baseline, mixed), "ate_rmse_m"), Change::kUnstable);
  EXPECT_EQ(ChangeOf(Compare(mixed, baseline), "ate_rmse_m"), Change::kCannotTell);
  EXPECT_NE(ChangeOf(Compare(baseline, loose), "ate_rmse_m"), Change::kUnstable);
  const Verdict verdict = On(GateVerdicts(baseline, mixed), "ate_rmse_m");
  EXPECT_FALSE(verdict.passed);
  EXPECT_NE(verdict.why.find("4 of 9 seeds got far worse"), std::string::npos) << verdict.why;
}

TEST(GateTest, SeedsThatScatterByAFactorOfTwoAreNoAlarm) {
  int alarms = 0;
  for (std::uint64_t night = 0; night < 200; ++night) {
    std::mt19937_64 random(night);
    std::lognormal_distribution<double> spread(0, 0.35);
    Results before, after;
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
      before.runs.push_back(MakeRecordOf("x", seed, 0.02 * spread(random)));
      after.runs.push_back(MakeRecordOf("x", seed, 0.02 * spread(random)));
    }
    const auto comparisons = Compare(before, after);
    alarms += std::any_of(comparisons.begin(), comparisons.end(),
                          [](const Comparison& c) { return IsAlarm(c.change); });
  }
  EXPECT_LE(alarms, 2);
}

}  // namespace
}  // namespace aisle
