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

TEST(TwinsTest, TheErrorIsSplitByTheSystemsOwnDrives) {
  Results results;
  results.runs = {Driven("robust", "live", 0.10), Driven("plain", "live", 0.30),
                  Driven("robust", "frozen", 0.06), Driven("robust", "empty", 0.02)};
  AddDynamicPenalty(&results.runs);
  EXPECT_DOUBLE_EQ(*results.runs[0].scores.at("dynamic_penalty").value, 5);
  EXPECT_EQ(results.runs[3].scores.count("dynamic_penalty"), 0u);
  const std::vector<CostSplit> splits = SplitCosts(GroupByScene(results));
  ASSERT_EQ(splits.size(), 1u);  // of plain there is nothing to hold against
  EXPECT_NEAR(*splits[0].occlusion_m, 0.04, 1e-12);
  EXPECT_NEAR(*splits[0].motion_m, 0.04, 1e-12);
  EXPECT_NEAR(*splits[0].rejection_m, -0.20, 1e-12);
  EXPECT_DOUBLE_EQ(*splits[0].penalty, 5);
}

TEST(TwinsTest, WhatIsNotOfAWholeDriveIsHeldAgainstNothing) {
  Results results;
  results.runs = {Driven("robust", "live", 0.001), Driven("plain", "live", 0.30),
                  Driven("oracle", "live", 0.01)};
  results.runs[0].scores["coverage"].value = 0.09;
  const std::vector<CostSplit> splits = SplitCosts(GroupByScene(results));
  ASSERT_EQ(splits.size(), 1u);
  EXPECT_EQ(splits[0].system, "oracle");
  EXPECT_NEAR(*splits[0].rejection_m, -0.29, 1e-12);
}

TEST(TwinsTest, OfAForeignSystemNothingIsPutDownToARejection) {
  Results results;
  results.runs = {Driven("mine", "live", 0.10), Driven("mine", "empty", 0.02),
                  Driven("plain", "live", 0.30), Driven("oracle", "live", 0.01)};
  for (RunRecord& run : results.runs) {
    if (run.spec.system.name == "mine") {
      run.spec.system = {.name = "mine", .external = ExternalSystem{.command = "mine"}};
    }
  }
  const std::vector<CostSplit> splits = SplitCosts(GroupByScene(results));
  ASSERT_EQ(splits[0].system, "mine");
  EXPECT_FALSE(splits[0].rejection_m.has_value());
  EXPECT_FALSE(splits[0].occlusion_m.has_value());  // nobody stood still
}

TEST(TwinsTest, TheTwinWithoutRejectionStandsOnTheSameBase) {
  const SystemSpec robust = BuiltIn("robust"), paper = BuiltIn("paper");
  EXPECT_TRUE(IsWithoutRejection(BuiltIn("plain"), robust));
  EXPECT_FALSE(IsWithoutRejection(BuiltIn("orbslam2"), robust));
  EXPECT_TRUE(IsWithoutRejection(BuiltIn("orbslam2"), paper));
  EXPECT_FALSE(IsWithoutRejection(BuiltIn("oracle"), robust));
  SystemSpec few{.name = "few", .like = "robust", .options = {{"feature.features", "400"}}};
  EXPECT_FALSE(IsWithoutRejection(BuiltIn("plain"), few));
  few.options = {{"dynamic.robust.field.memory", "0.4"}};
  EXPECT_TRUE(IsWithoutRejection(BuiltIn("plain"), few));
}

TEST(TwinsTest, WhatAVariantsOptionsTurnOnOrOffIsItsRejection) {
  const SystemSpec on{.name = "on", .like = "plain", .options = {{"dynamic.method", "robust"}}};
  const SystemSpec off{.name = "off", .like = "robust", .options = {{"dynamic.method", "none"}}};
  EXPECT_TRUE(IsWithoutRejection(off, BuiltIn("robust")));
  EXPECT_TRUE(IsWithoutRejection(BuiltIn("plain"), on));
  EXPECT_TRUE(IsWithoutRejection(off, on));
  EXPECT_FALSE(IsWithoutRejection(on, BuiltIn("robust")));
  EXPECT_FALSE(IsWithoutRejection(BuiltIn("plain"), off));
  SystemSpec foreign{.name = "mine"};
  foreign.external.emplace();
  EXPECT_FALSE(IsWithoutRejection(foreign, BuiltIn("robust")));
  EXPECT_FALSE(IsWithoutRejection(BuiltIn("plain"), foreign));
}

}  // namespace
}  // namespace aisle
