#include "harness/judge/missing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Results Night(const std::vector<std::string>& scenes, std::uint64_t seeds) {
  Results night;
  for (const std::string& scene : scenes) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      RunRecord& run = night.runs.emplace_back();
      run.spec = {.scene = scene,
                  .scene_file = "",
                  .twin = "live",
                  .system = BuiltIn("plain"),
                  .seed = seed};
    }
  }
  return night;
}

TEST(MissingRunsTest, AreWholeCellsAndSeedsOfOthers) {
  const Results before = Night({"a", "b"}, 9), after = Night({"a"}, 5);
  const auto missing = MissingRunsOf(before, after);
  ASSERT_EQ(missing.size(), 2u);
  EXPECT_FALSE(missing[0].is_whole);
  EXPECT_THAT(missing[0].seeds, ElementsAre(6, 7, 8, 9));
  EXPECT_TRUE(missing[1].is_whole);
  EXPECT_EQ(missing[1].scene, "b");
  EXPECT_EQ(InWords(missing), "1 cell and 4 seeds of 1 other are missing");
  EXPECT_EQ(InWords({missing[0]}), "4 seeds of 1 cell are missing");
  EXPECT_EQ(InWords({missing[1]}), "1 cell is missing");
  EXPECT_THAT(MissingRunsOf(after, before), IsEmpty());
  EXPECT_EQ(InWords({}), "");
}

TEST(UnfinishedRunsTest, AreThoseThatFailedThatWerePlannedAndThatAVerdictNames) {
  Results night = Night({"a"}, 3);
  std::vector<RunSpec> planned;
  for (const RunRecord& run : Night({"a"}, 4).runs) planned.push_back(run.spec);
  EXPECT_THAT(UnfinishedRuns(night, {}), IsEmpty());
  EXPECT_THAT(UnfinishedRuns(night, planned), ElementsAre("a/live/plain/4"));
  night.runs[1].status = RunStatus::kCrashed;
  Verdict& lost = night.verdicts.emplace_back();
  lost.name = "a/live/plain/7: completes";
  EXPECT_THAT(UnfinishedRuns(night, {}), ElementsAre("a/live/plain/2", "a/live/plain/7"));
}

}  // namespace
}  // namespace aisle
