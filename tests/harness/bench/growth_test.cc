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

}  // namespace
}  // namespace aisle
