#include "harness/bench/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "harness/plugs/simulated_sequence.h"

namespace aisle {
namespace {

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

TEST(Scaling, OfAmdahlsLawIsItsInverse) {
  for (const double share : {0.0, 0.05, 0.3, 1.0}) {
    for (const int threads : {2, 3, 8}) {
      EXPECT_NEAR(SerialShare(400, 400 / SpeedUp(share, threads), threads), share, 1e-12);
    }
  }
  EXPECT_DOUBLE_EQ(SpeedUp(0, 16), 16);
  EXPECT_DOUBLE_EQ(SpeedUp(1, 16), 1);
  EXPECT_DOUBLE_EQ(SpeedUp(0.05, 16), 16 / 1.75);
  EXPECT_EQ(SerialShare(100, 40, 2), 0);  // faster than twice: noise
}

TEST(ScalingTable, SetsOneThreadBesideSeveralOfTheSameScene) {
  GrowthRow two{.scene = {.actors = 3}, .threads = 2, .cost = {}};
  two.cost.pair_ms = 210;
  GrowthRow wide = two, other = two, one = two;
  wide.scene.width = 1280;
  wide.cost.pair_ms = 500;
  other.scene.actors = 0;
  one.threads = 1;
  one.cost.pair_ms = 400;
  EXPECT_THAT(ScalingTable({wide, other, two, one}),
              HasSubstr("\n| 3 | 2 | 0.050 | 3.5 | 3.5 | 5.9 | 7.0 | 9.1 | 13.9 |\n"));
  EXPECT_EQ(ScalingTable({wide, two}), "");
}

}  // namespace
}  // namespace aisle
