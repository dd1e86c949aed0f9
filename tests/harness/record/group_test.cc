#include "harness/record/group.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/record/seed_values.h"
#include "harness/systems/built_in.h"

namespace aisle {
namespace {

RunRecord RunOf(std::uint64_t seed, std::optional<double> ate_m,
                RunStatus status = RunStatus::kOk) {
  RunRecord run;
  run.spec = {.scene = "s", .scene_file = "", .system = BuiltIn("plain"), .seed = seed};
  run.status = status;
  run.scores["ate_rmse_m"].value = ate_m;
  return run;
}

TEST(StylesTest, ASystemLooksTheSameInWhateverCompany) {
  const auto all = StylesOf({"orbslam2", "plain", "semantic", "paper", "robust", "oracle", "mine"});
  const auto few = StylesOf({"robust", "mine"});
  EXPECT_EQ(all.at("robust"), few.at("robust"));
  EXPECT_EQ(all.at("mine"), few.at("mine"));
  std::set<int> styles;
  for (const auto& [name, style] : all) styles.insert(style);
  EXPECT_EQ(styles.size(), all.size());
}

TEST(StylesTest, EveryBuiltInSystemHasAStyleOfItsOwn) {
  std::set<int> styles;
  for (const System& system : Systems()) styles.insert(StylesOf({system.name}).begin()->second);
  EXPECT_EQ(styles.size(), Systems().size());
  EXPECT_LT(*styles.rbegin(), kStyles / 2) << "the other half is for variants and foreign systems";
}

TEST(StylesTest, SixOthersAreApartFromEachOtherAndFromOurs) {
  const auto styles = StylesOf({"a", "b", "c", "d", "e", "f", "oracle"});
  std::set<int> seen;
  for (const auto& [name, style] : styles) {
    EXPECT_GE(style, 0);
    EXPECT_LT(style, kStyles);
    seen.insert(style);
  }
  EXPECT_EQ(seen.size(), 7u);
}

TEST(GroupTest, TheWorstRunIsTheOneThatFailedElseTheLargestError) {
  const RunRecord small = RunOf(1, 0.1), large = RunOf(2, 0.3), none = RunOf(3, {});
  const RunRecord crashed = RunOf(4, {}, RunStatus::kCrashed);
  EXPECT_EQ(WorstRun({&small, &large, &none}), &large);
  EXPECT_EQ(WorstRun({&small, &crashed, &large}), &crashed);
  EXPECT_EQ(WorstRun({}), nullptr);
}

TEST(GroupTest, ASeedCountsOnceHoweverOftenItRan) {
  std::vector<RunRecord> all;
  for (const double ate_m : {0.1, 0.1, 0.1, 0.4}) all.push_back(RunOf(1, ate_m));
  all.push_back(RunOf(2, 0.5));
  all.push_back(RunOf(3, 0.6));
  for (std::size_t i = 0; i < 4; ++i) all[i].spec.repeat = static_cast<int>(i) + 1;
  std::vector<const RunRecord*> runs;
  for (const RunRecord& run : all) runs.push_back(&run);
  EXPECT_THAT(ScoresOf(runs, "ate_rmse_m"), testing::ElementsAre(0.1, 0.5, 0.6));
  EXPECT_EQ(MedianScore(runs, "ate_rmse_m"), 0.5);
  EXPECT_EQ(CountSeeds(runs), 3u);
  all.back().spec.scene = "t";  // another scene's seed 3 is another drive, and so would its 1 be
  all.back().spec.seed = 1;
  EXPECT_THAT(ScoresOf(runs, "ate_rmse_m"), testing::ElementsAre(0.1, 0.5, 0.6));
  EXPECT_EQ(CountSeeds(runs), 3u);
}

TEST(GroupTest, AMedianNeedsAllRunsAndTheListThoseThatHaveOne) {
  const RunRecord one = RunOf(1, 0.1), none = RunOf(2, {});
  EXPECT_FALSE(MedianScore({&one, &none}, "ate_rmse_m").has_value());
  EXPECT_THAT(ScoresOf({&one, &none}, "ate_rmse_m"), testing::ElementsAre(0.1));
}

}  // namespace
}  // namespace aisle
