#include "harness/bench/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "harness/plugs/simulated_sequence.h"

namespace aisle {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::size_t Count(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

TEST(GrowthScene, IsAGoodSceneOfAsManyActorsAsAsked) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("aisle_growth_test_" + std::to_string(::getpid()) + ".yaml");
  for (const GrowthSeries& series : GrowthPlan({})) {
    for (const int actors : series.actors) {
      GrowthScene scene = series.scene;
      scene.actors = actors;
      const std::string text = GrowthSceneText(scene);
      EXPECT_EQ(Count(text, "- name: actor_"), static_cast<std::size_t>(actors));
      std::ofstream(file) << text;
      EXPECT_THAT(CheckScene(file.string()), IsEmpty()) << text;
    }
  }
  std::filesystem::remove(file);
}

TEST(GrowthScene, FewerActorsAreTheFirstOfMore) {
  const std::string six = GrowthSceneText({.actors = 6}), twelve = GrowthSceneText({.actors = 12});
  std::istringstream lines(six);
  for (std::string line; std::getline(lines, line);) EXPECT_THAT(twelve, HasSubstr(line));
}

TEST(GrowthScene, RefusesMoreActorsThanThereAre) {
  EXPECT_THROW(GrowthSceneText({.actors = kMostGrowthActors + 1}), std::invalid_argument);
  EXPECT_THROW(GrowthSceneText({.actors = -1}), std::invalid_argument);
}

TEST(GrowthPlan, BeginsEachSeriesWithNobodyAndReachesTwelve) {
  for (const GrowthSeries& series : GrowthPlan({})) {
    EXPECT_EQ(series.actors.front(), 0);
    EXPECT_EQ(series.actors.back(), kMostGrowthActors);
  }
}

TEST(GrowthTable, HasARowALine) {
  GrowthRow row{.scene = {.actors = 12},
                .threads = 2,
                .cost = {.pair_ms = 300,
                         .bare_primary_ms = 60,
                         .ratio = 5,
                         .frames = 8,
                         .triangles = 212'400,
                         .moving_triangles = 99'600,
                         .stage_ms = {}},
                .of_none = 1.75};
  EXPECT_THAT(GrowthTable({row, row}),
              HasSubstr("\n| 12 | 212 k, 100 k | 752 x 480 | 2 | 300 | 60.0 | **5.00** | 1.75 |\n"
                        "| 12 |"));
}

TEST(GrowthPlan, DoublesTheThreadsUpToAll) {
  const auto threads_of = [](int threads) {
    GrowthOptions options;
    options.threads = threads;
    std::set<int> counts;
    for (const GrowthSeries& series : GrowthPlan(options)) counts.insert(series.threads);
    return counts;
  };
  EXPECT_THAT(threads_of(1), ElementsAre(1));
  EXPECT_THAT(threads_of(2), ElementsAre(1, 2));
  EXPECT_THAT(threads_of(6), ElementsAre(1, 2, 4, 6));
}

std::vector<ThreadTime> Lawful(double serial_share) {
  std::vector<ThreadTime> times;
  for (const int threads : {1, 2, 4, 8}) {
    times.push_back({threads, 400 / SpeedUp(serial_share, threads)});
  }
  return times;
}

TEST(Scaling, FitOfTimesThatFollowAmdahlsLawFindsItsShare) {
  for (const double share : {0.0, 0.05, 0.3, 1.0}) {
    const auto fit = FitScaling(Lawful(share));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->serial_share, share, 1e-12);
    EXPECT_NEAR(fit->residual, 0, 1e-12);
  }
  EXPECT_DOUBLE_EQ(SpeedUp(0, 16), 16);
  EXPECT_DOUBLE_EQ(SpeedUp(1, 16), 1);
  EXPECT_DOUBLE_EQ(SpeedUp(0.05, 16), 16 / 1.75);
}

TEST(Scaling, FitSaysHowFarTheTimesAreFromTheLaw) {
  std::vector<ThreadTime> times = Lawful(0.05);
  times[1].ms *= 1.1;
  const auto fit = FitScaling(times);
  ASSERT_TRUE(fit);
  EXPECT_GT(fit->residual, 0.02);
  EXPECT_LT(fit->residual, 0.1);
}

TEST(Scaling, TwoNumbersOfThreadsAreNoFit) {
  EXPECT_FALSE(FitScaling({{1, 400}, {2, 210}}));
  EXPECT_FALSE(FitScaling({{1, 400}, {2, 210}, {2, 212}}));
}

GrowthRow On(int threads, double pair_ms) {
  GrowthRow row{.scene = {.actors = 3}, .threads = threads, .cost = {}};
  row.cost.pair_ms = pair_ms;
  return row;
}

TEST(ScalingTable, SetsOneThreadBesideSeveralOfTheSameScene) {
  GrowthRow wide = On(2, 500), other = On(2, 210);
  wide.scene.width = 1280;
  other.scene.actors = 0;
  EXPECT_EQ(ScalingTable({wide, other, On(2, 210), On(1, 400)}),
            "| actors | threads | pair on one thread, ms | on all, ms | times as fast | efficiency "
            "|\n|---:|---:|---:|---:|---:|---:|\n| 3 | 2 | 400 | 210 | 1.90 | 0.95 |\n");
  EXPECT_EQ(ScalingTable({wide, On(2, 210)}), "");
}

TEST(ScalingTable, ForecastsFromThreeNumbersOfThreads) {
  // 400 ms, of them 20 one after the other.
  const std::string table = ScalingTable({On(4, 115), On(2, 210), On(1, 400)});
  EXPECT_THAT(table, HasSubstr("\n| 3 | 2 | 400 | 210 | 1.90 | 0.95 |\n"
                               "| 3 | 4 | 400 | 115 | 3.48 | 0.87 |\n\n| actors |"));
  EXPECT_THAT(table, HasSubstr("\n| 3 | 0.050 | 0.0 | 3.5 | 5.9 | 9.1 |\n"));
}

TEST(ScalingTable, ForecastsNothingWhereMoreThreadsAreMoreThanAsFast) {
  const std::string table = ScalingTable({On(4, 80), On(2, 190), On(1, 400)});
  EXPECT_THAT(table, HasSubstr("| 3 | 4 | 400 | 80 | 5.00 | 1.25 |\n"));
  EXPECT_THAT(table, ContainsRegex("\n\\| 3 \\| - \\| [0-9.]+ \\| - \\| - \\| - \\|\n"));
}

}  // namespace
}  // namespace aisle
