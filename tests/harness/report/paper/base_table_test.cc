#include "harness/report/paper/base_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

RunRecord RunOf(const SystemSpec& system, double ate_m, std::uint64_t seed = 1) {
  RunRecord run;
  run.spec = {
      .scene = "paper/scene2", .scene_file = "", .twin = "live", .system = system, .seed = seed};
  run.scores["ate_rmse_m"] = {
      .value = ate_m, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
  return run;
}

SystemSpec OnBase(const std::string& like, const std::string& base) {
  return {.name = like + "_" + base, .like = like, .options = {{"base", base}}};
}

TEST(BaseTable, PutsEachRejectionOnBothBases) {
  Results results;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const double more = 0.01 * static_cast<double>(seed);
    results.runs.push_back(RunOf(BuiltIn("orbslam2"), 1 + more, seed));
    results.runs.push_back(RunOf(BuiltIn("plain"), 0.1 + more, seed));
    results.runs.push_back(RunOf(BuiltIn("paper"), 0.2 + more, seed));
    results.runs.push_back(RunOf(OnBase("paper", "plain"), 0.05 + more, seed));
    results.runs.push_back(RunOf(BuiltIn("robust"), 0.003, seed));
  }
  const auto table = BaseTable(GroupByScene(results));
  ASSERT_TRUE(table);
  EXPECT_THAT(table->groups, ElementsAre("nothing", "paper", "robust"));
  EXPECT_THAT(table->columns, ElementsAre("orbslam2", "plain"));
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_THAT(table->rows[0].cells,
              ElementsAre("1.0200", "0.1200", "0.2200", "0.0700", "-", "0.0030"));
  EXPECT_TRUE(table->rows[1].spread);
  EXPECT_EQ(table->rows[1].cells[0], "1.0100–1.0300");
  EXPECT_THAT(
      ToMarkdown({*table}),
      HasSubstr("| scene | rejection | orbslam2 \\[m] | plain \\[m] |\n|---|---|---:|---:|\n"
                "| paper/scene2 | nothing | 1.0200 (1.0100 to 1.0300) | "
                "0.1200 (0.1100 to 0.1300) |\n"));
  EXPECT_THAT(ToMarkdown({*table}), HasSubstr("| robust | - | 0.0030 (0.0030 to 0.0030) |\n"));
  // The variant stands there and in no other table.
  for (const NumberTable& other : PaperTables(GroupByScene(results))) {
    if (other.title == table->title) continue;
    EXPECT_THAT(other.groups, ElementsAre("orbslam2", "plain", "paper", "robust")) << other.title;
  }
}

TEST(BaseTable, NeedsARejectionOnTwoBases) {
  Results results;
  results.runs = {RunOf(BuiltIn("orbslam2"), 1), RunOf(BuiltIn("robust"), 0.003)};
  EXPECT_FALSE(BaseTable(GroupByScene(results)));
}

TEST(BaseTable, LeavesOutWhatDiffersByMoreThanItsBase) {
  SystemSpec fast{.name = "fast", .like = "paper", .options = {{"feature.features", "500"}}};
  SystemSpec blurred{.name = "blurred", .like = "oracle", .mask_errors = {.boundary_px = 3}};
  SystemSpec foreign{.name = "mine"};
  foreign.external.emplace();
  Results results;
  results.runs = {RunOf(BuiltIn("orbslam2"), 1), RunOf(BuiltIn("plain"), 0.1), RunOf(fast, 2),
                  RunOf(blurred, 3), RunOf(foreign, 4)};
  const auto table = BaseTable(GroupByScene(results));
  ASSERT_TRUE(table);
  EXPECT_THAT(table->groups, ElementsAre("nothing"));
  EXPECT_FALSE(IsOnAnotherBase(fast));
  EXPECT_FALSE(IsOnAnotherBase(BuiltIn("plain")));
  EXPECT_TRUE(IsOnAnotherBase(OnBase("oracle", "orbslam2")));
}

TEST(BaseTable, ARejectionSetByAnOptionIsThatRejection) {
  const SystemSpec off{.name = "off", .like = "robust", .options = {{"dynamic.method", "none"}}};
  const SystemSpec on{.name = "on", .like = "orbslam2", .options = {{"dynamic.method", "robust"}}};
  Results results;
  results.runs = {RunOf(BuiltIn("orbslam2"), 1), RunOf(off, 0.1), RunOf(on, 0.2),
                  RunOf(BuiltIn("robust"), 0.003)};
  const auto table = BaseTable(GroupByScene(results));
  ASSERT_TRUE(table);
  EXPECT_THAT(table->groups, ElementsAre("nothing", "robust"));
  EXPECT_THAT(table->rows[0].cells, ElementsAre("1.0000", "0.1000", "0.2000", "0.0030"));
  EXPECT_FALSE(IsOnAnotherBase(off));
  EXPECT_FALSE(IsOnAnotherBase(on));
}

TEST(BaseTable, HasNoNumberWhereASeedHasNone) {
  Results results;
  results.runs = {RunOf(BuiltIn("orbslam2"), 1), RunOf(BuiltIn("plain"), 0.1),
                  RunOf(BuiltIn("plain"), 0.1, 2)};
  results.runs.back().scores.clear();
  const auto table = BaseTable(GroupByScene(results));
  ASSERT_TRUE(table);
  EXPECT_THAT(table->rows[0].cells, ElementsAre("1.0000", "-"));
}

}  // namespace
}  // namespace aisle
