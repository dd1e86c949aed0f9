// What `compare` and `baseline` make of nights with holes; no run is driven for it.
#include <gmock/gmock.h>

#include "harness/io/file.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TwoNightsTest : public ProgramTest {
 protected:
  /// The report's folder of a night of these systems over so many seeds.
  std::string Night(const std::string& name, const std::vector<std::string>& systems,
                    std::uint64_t seeds, RunStatus status_of_last = RunStatus::kOk) const {
    Results night;
    night.suite = "made";
    for (const std::string& system : systems) {
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        RunRecord& run = night.runs.emplace_back();
        run.spec = {.scene = "s",
                    .scene_file = "",
                    .twin = "live",
                    .system = BuiltIn(system),
                    .seed = seed};
        run.scores["ate_rmse_m"] = {.value = 0.01 + 0.001 * static_cast<double>(seed),
                                    .unit = "m",
                                    .alignment = "se3",
                                    .n = 1,
                                    .absent = ""};
      }
    }
    night.runs.back().status = status_of_last;
    WriteFileAtomically(fs::path(Out(name)) / "results.json", ToJson(night));
    return Out(name);
  }
};

TEST_F(TwoNightsTest, ACellOrSeedsThatVanishedFailAComparison) {
  const std::string all = Night("all", {"plain", "robust"}, 9);
  const std::string fewer = Night("fewer", {"plain", "robust"}, 5);
  const std::string without = Night("without", {"plain"}, 9);
  EXPECT_EQ(Run({"compare", all, all}).code, 0);
  const Said cell = Run({"compare", all, without});
  EXPECT_EQ(cell.code, 1) << cell.text;
  EXPECT_THAT(cell.text, HasSubstr("1 cell is missing"));
  const Said seeds = Run({"compare", all, fewer});
  EXPECT_EQ(seeds.code, 1) << seeds.text;
  EXPECT_THAT(seeds.text, HasSubstr("8 seeds of 2 cells are missing"));
  EXPECT_EQ(Run({"compare", without, all}).code, 0) << "what is new is no alarm";
  EXPECT_THAT(Run({"compare", all, without, "--json"}).text, HasSubstr("\"missing\": ["));
}

/// A crash before leaves no score to compare; that the rest has vanished is told all the same.
TEST_F(TwoNightsTest, WhatVanishedFailsAComparisonThatHasNoScores) {
  const std::string old_night = Night("old", {"plain", "robust"}, 3);
  const std::string new_night = Night("new", {"robust"}, 3);
  Results crashed = ResultsOf(old_night);
  for (RunRecord& run : crashed.runs) {
    if (run.spec.system.name != "robust") continue;
    run.status = RunStatus::kCrashed;
    run.scores.clear();
  }
  WriteFileAtomically(fs::path(old_night) / "results.json", ToJson(crashed));
  const Said said = Run({"compare", old_night, new_night, "--out", Out("compared")});
  EXPECT_EQ(said.code, 1) << said.text;
  EXPECT_THAT(said.text, HasSubstr("1 cell is missing"));
  EXPECT_THAT(ReadFile(fs::path(Out("compared")) / "compare.html"), HasSubstr("all of it"));
  EXPECT_EQ(Run({"compare", new_night, Night("other", {"plain"}, 3)}).code, 5) << "nothing shared";
}

TEST_F(TwoNightsTest, ANightWithHolesIsNoBaselineUnlessAsked) {
  const std::string whole = Night("whole", {"plain"}, 3);
  const std::string holes = Night("holes", {"plain"}, 3, RunStatus::kCrashed);
  const std::string to = Out("baseline.json");
  const Said refused = Run({"baseline", holes, "--to", to});
  EXPECT_EQ(refused.code, 4) << refused.text;
  EXPECT_THAT(refused.text, HasSubstr("s/live/plain/3"));
  EXPECT_FALSE(fs::exists(to));
  EXPECT_EQ(Run({"baseline", holes, "--to", to, "--anyway"}).code, 0);
  EXPECT_TRUE(fs::exists(to));
  EXPECT_EQ(Run({"baseline", whole, "--to", to}).code, 0);
}

}  // namespace
}  // namespace aisle
