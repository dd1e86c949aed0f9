#include "harness/report/block/score_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

RunRecord RunWith(std::uint64_t seed, double ate_m) {
  RunRecord run;
  run.spec = {.scene = "paper/scene2",
              .scene_file = "",
              .twin = "live",
              .system = BuiltIn("plain"),
              .seed = seed};
  run.scores["ate_rmse_m"] = {
      .value = ate_m, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
  return run;
}

TEST(ScoreTable, HasARowASystemAndTheSpreadOverSeeds) {
  Results results;
  results.runs = {RunWith(1, 0.5), RunWith(2, 0.25), RunWith(3, 1.75)};
  results.runs.front().scores["coverage"] = {
      .value = 1, .unit = "1", .alignment = "", .n = 9, .absent = ""};
  EXPECT_EQ(ScoreTable(results, {"ate_rmse_m"}),
            "| scene | twin | system | runs | ate_rmse_m, m |\n|---|---|---|---|---|\n"
            "| paper/scene2 | live | plain | 3 | 0.5 (0.25 to 1.75) |\n");
  // No median over seeds of which one has no value.
  EXPECT_THAT(ScoreTable(results, {"coverage"}), testing::HasSubstr("| 3 | - |"));
}

TEST(ScoreTable, HasNoRowForRunsThatAreNotAskedForTheScores) {
  Results results;
  results.runs = {RunWith(1, 0.5), RunWith(1, 0.25)};
  results.runs[0].scores["dynamic_penalty"].value = 2;
  results.runs[1].spec.twin = "empty";
  EXPECT_THAT(ScoreTable(results, {"dynamic_penalty"}), testing::Not(testing::HasSubstr("empty")));
  results.runs[1].status = RunStatus::kLost;
  EXPECT_THAT(ScoreTable(results, {"dynamic_penalty"}), testing::HasSubstr("| empty | plain |"));
}

TEST(ScoreTable, RefusesAScoreThatNoRunHas) {
  Results results;
  results.runs = {RunWith(1, 0.5)};
  try {
    ScoreTable(results, {"ate_rms_m"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean ate_rmse_m"));
  }
}

}  // namespace
}  // namespace aisle
