#include "harness/judge/twins.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

RunRecord Driven(const std::string& system, const std::string& twin, double ate_m) {
  RunRecord run;
  run.spec = {.scene = "s", .scene_file = "", .twin = twin, .system = BuiltIn(system), .seed = 1};
  run.scores["ate_rmse_m"] = {
      .value = ate_m, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
  return run;
}

TEST(TwinsTest, TheErrorIsSplitIntoItsCauses) {
  Results results;
  results.runs = {Driven("orbslam2", "live", 0.10), Driven("oracle", "live", 0.03),
                  Driven("orbslam2", "empty", 0.02), Driven("oracle", "empty", 0.02)};
  AddDynamicPenalty(&results.runs);
  EXPECT_DOUBLE_EQ(*results.runs[0].scores.at("dynamic_penalty").value, 5);
  EXPECT_EQ(results.runs[2].scores.count("dynamic_penalty"), 0u);
  const std::vector<CostSplit> splits = SplitCosts(GroupByScene(results));
  ASSERT_EQ(splits.size(), 2u);
  EXPECT_NEAR(*splits[0].occlusion_m, 0.01, 1e-12);
  EXPECT_NEAR(*splits[0].mask_m, 0.07, 1e-12);
  EXPECT_DOUBLE_EQ(*splits[0].penalty, 5);
  EXPECT_FALSE(splits[1].mask_m.has_value());  // the oracle is its own measure
}

}  // namespace
}  // namespace aisle
