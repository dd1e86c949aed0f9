#include "harness/judge/change_size.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

Comparison Of(Change change, double before, double after) {
  Comparison c;
  c.change = change;
  c.old_median = before;
  c.new_median = after;
  c.new_n = 9;
  return c;
}

TEST(ChangeSizeTest, AlarmsComeFirstAndEachBySize) {
  std::vector<Comparison> list{Of(Change::kSame, 1, 9), Of(Change::kBetter, 4, 1),
                               Of(Change::kWorse, 1, 1.5), Of(Change::kWorse, 1, 4)};
  LargestFirst(&list);
  EXPECT_EQ(list[0].new_median, 4);
  EXPECT_EQ(list[1].new_median, 1.5);
  EXPECT_EQ(list[2].change, Change::kBetter);
  EXPECT_DOUBLE_EQ(SizeOf(Of(Change::kWorse, 1, 2)), SizeOf(Of(Change::kBetter, 2, 1)));
}

TEST(ChangeSizeTest, ASystemOverAllItsCellsStandsBeforeItsCells) {
  Comparison over_all = Of(Change::kWorse, 1, 1.1);
  over_all.cells = 5;
  over_all.factor = 1.3;
  EXPECT_EQ(PercentOfChange(over_all), "+30.0 %");
  EXPECT_DOUBLE_EQ(SizeOf(over_all), std::log(1.3));
  std::vector<Comparison> list{Of(Change::kSame, 1, 9), Of(Change::kWorse, 1, 4), over_all};
  LargestFirst(&list);
  EXPECT_EQ(list[0].cells, 5u);
  EXPECT_EQ(list[1].new_median, 4);
}

TEST(ChangeSizeTest, TheSeedThatMovedFarthestIsNamed) {
  Results before, after;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RunRecord run;
    run.spec = {.scene = "s", .scene_file = "", .system = BuiltIn("plain"), .seed = seed};
    run.scores["ate_rmse_m"].value = 0.1;
    before.runs.push_back(run);
    run.scores["ate_rmse_m"].value = seed == 2 ? 0.5 : 0.2;
    after.runs.push_back(run);
  }
  Comparison c = Of(Change::kWorse, 0.1, 0.2);
  c.scene = "s";
  c.twin = "live";
  c.system = "plain";
  c.score = "ate_rmse_m";
  EXPECT_EQ(FarthestSeed(before, after, c)->after->spec.seed, 2u);
  after.runs[2].scores.clear();
  EXPECT_EQ(FarthestSeed(before, after, c)->after->spec.seed, 3u);  // what is gone is farther
  EXPECT_EQ(WhyNothingShared(before, after), "");
  c.scene = "elsewhere";
  EXPECT_FALSE(FarthestSeed(before, after, c).has_value());
}

/// Nine seeds, all of one value but for the last.
Results Night(const std::string& score, double value, double of_last) {
  Results night;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    RunRecord& run = night.runs.emplace_back();
    run.spec = {.scene = "s", .scene_file = "", .system = BuiltIn("plain"), .seed = seed};
    run.scores[score] = {seed == 9 ? of_last : value, "1", "", 1, ""};
  }
  return night;
}

/// The medians do not move where one seed breaks: they say neither which way nor whom.
TEST(ChangeSizeTest, OfAnUnstableScoreTheSeedThatBrokeIsNamed) {
  for (const auto& [score, good, bad] :
       {std::tuple("goal_reached", 1.0, 0.0), std::tuple("collisions", 0.0, 1.0)}) {
    const Results before = Night(score, good, good), after = Night(score, good, bad);
    const std::vector<Comparison> all = Compare(before, after);
    ASSERT_EQ(all.size(), 1u);
    ASSERT_EQ(all[0].change, Change::kUnstable) << score;
    const auto seed = FarthestSeed(before, after, all[0]);
    ASSERT_TRUE(seed) << score;
    EXPECT_EQ(seed->after->spec.seed, 9u) << score;
    EXPECT_EQ(seed->new_value, bad) << score;
  }
}

/// Nor does a median that got better while one seed broke.
TEST(ChangeSizeTest, OfAnUnstableScoreTheMediansSayNothing) {
  Results before = Night("ate_rmse_m", 0.1, 0.1), after = Night("ate_rmse_m", 0.0999, 5);
  Comparison c = Of(Change::kUnstable, 0.1, 0.0999);
  std::tie(c.scene, c.twin, c.system, c.score) =
      std::tuple("s", before.runs[0].spec.twin, "plain", "ate_rmse_m");
  EXPECT_EQ(FarthestSeed(before, after, c)->after->spec.seed, 9u);
}

}  // namespace
}  // namespace aisle
