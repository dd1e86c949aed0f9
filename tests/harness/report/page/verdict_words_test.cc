#include "harness/report/page/verdict_words.h"

#include <gtest/gtest.h>

#include "harness/judge/limit.h"

namespace aisle {
namespace {

RunRecord RunOf(const std::string& scene, const std::string& system, double ate_m) {
  RunRecord run;
  run.spec = {scene, scene + ".yaml", "live", BuiltIn(system), 1};
  run.status = RunStatus::kOk;
  run.scores["ate_rmse_m"] = {
      .value = ate_m, .unit = "m", .alignment = "se3", .n = 1, .absent = ""};
  return run;
}

const Limit kTight{.score = "ate_rmse_m", .system = "oracle", .max = 0.02};
const Limit kHigh{.score = "ate_rmse_m", .system = "plain", .min = 0.3};

/// Each limit speaks of three cells here: six verdicts are not six limits.
TEST(VerdictsInWords, LimitsAreToldFromTheCellsInWhichTheyAreJudged) {
  std::vector<RunRecord> runs;
  for (const char* scene : {"a", "b", "c"}) {
    runs.push_back(RunOf(scene, "oracle", 0.5));
    runs.push_back(RunOf(scene, "plain", 0.1));
  }
  const std::vector<Verdict> verdicts = Judge(runs, {kTight, kHigh});
  ASSERT_EQ(verdicts.size(), 6u);
  EXPECT_EQ(VerdictsInWords(verdicts, 2), "6 of 6 verdicts failed (2 limits, in 6 cells)");
  EXPECT_EQ(VerdictsInWords(verdicts, 0), "6 of 6 verdicts failed (limits on 1 score, in 6 cells)");
}

TEST(VerdictsInWords, WhatPassedIsSaidAsWell) {
  const std::vector<Verdict> verdicts = Judge({RunOf("a", "oracle", 0.01)}, {kTight});
  EXPECT_EQ(VerdictsInWords(verdicts, 1), "1 of 1 verdicts passed (1 limit, in 1 cell)");
  EXPECT_EQ(VerdictsInWords({}, 0), "");
}

TEST(VerdictsInWords, ABaselineAndFailedRunsAreNoLimits) {
  std::vector<Verdict> verdicts = {{.name = "a live oracle: ate_rmse_m against the baseline",
                                    .passed = true,
                                    .why = "",
                                    .scene = "a",
                                    .twin = "live",
                                    .system = "oracle"},
                                   {.name = "a/live/plain/1: completes",
                                    .passed = false,
                                    .why = "crashed",
                                    .scene = "a",
                                    .twin = "live",
                                    .system = "plain"}};
  EXPECT_EQ(VerdictsInWords(verdicts, 0), "1 of 2 verdicts failed (the baseline, in 1 cell)");
  verdicts.push_back({.name = "all cells of oracle: ate_rmse_m against the baseline",
                      .passed = true,
                      .why = "",
                      .system = "oracle"});
  EXPECT_EQ(VerdictsInWords(verdicts, 0), "1 of 3 verdicts failed (the baseline, in 1 cell)");
  verdicts.pop_back();
  verdicts.erase(verdicts.begin());
  EXPECT_EQ(VerdictsInWords(verdicts, 0), "1 of 1 verdicts failed");
}

}  // namespace
}  // namespace aisle
