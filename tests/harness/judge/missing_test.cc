#include "harness/judge/missing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/judge/gate.h"

namespace aisle {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
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

std::vector<RunSpec> SpecsOf(const Results& night) {
  std::vector<RunSpec> specs;
  for (const RunRecord& run : night.runs) specs.push_back(run.spec);
  return specs;
}

/// What fails in the morning whatever the runs do is said in the evening, and nothing else is.
TEST(BoundToFailTest, IsANightThatLacksWhatItsBaselineHas) {
  const Results baseline = Night({"a", "b"}, 9);
  for (const std::uint64_t seeds : {9, 12}) {
    EXPECT_EQ(BoundToFail(baseline, SpecsOf(Night({"a", "b", "c"}, seeds))), "");
  }
  EXPECT_THAT(BoundToFail(baseline, SpecsOf(Night({"a", "b"}, 7))),
              AllOf(HasSubstr("4 seeds of 2 cells are missing tonight"),
                    HasSubstr("a live plain, seeds 8, 9; b live plain, seeds 8, 9."),
                    HasSubstr("Run them with --seeds 9, or make another baseline")));
  EXPECT_THAT(BoundToFail(baseline, SpecsOf(Night({"a"}, 9))),
              AllOf(HasSubstr("1 cell is missing tonight"), HasSubstr(": b live plain."),
                    HasSubstr("Leave out what takes scenes")));
  Results odd = Night({"a"}, 3);
  odd.runs.erase(odd.runs.begin());
  EXPECT_THAT(BoundToFail(odd, SpecsOf(Night({"a"}, 1))), HasSubstr("with --seed 2,3, or"));
}

TEST(UnfinishedRunsTest, AreThoseThatFailedThatWerePlannedAndThatAVerdictNames) {
  Results night = Night({"a"}, 3);
  const std::vector<RunSpec> planned = SpecsOf(Night({"a"}, 4));
  EXPECT_THAT(UnfinishedRuns(night, {}), IsEmpty());
  EXPECT_THAT(UnfinishedRuns(night, planned), ElementsAre("a/live/plain/4"));
  night.runs[1].status = RunStatus::kCrashed;
  Verdict& lost = night.verdicts.emplace_back();
  lost.name = "a/live/plain/7: completes";
  EXPECT_THAT(UnfinishedRuns(night, {}), ElementsAre("a/live/plain/2", "a/live/plain/7"));
}

}  // namespace
}  // namespace aisle
