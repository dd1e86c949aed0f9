#include "harness/suite/plan.h"

#include <gtest/gtest.h>

#include "harness/io/input_error.h"
#include "harness/record/record.h"

namespace aisle {
namespace {

PlanFile Example() {
  PlanFile plan;
  plan.command = "./aisle run x.yaml";
  plan.suites.resize(2);
  plan.suites[1].name = "second";
  Suite& suite = plan.suites[0];
  suite.name = "x";
  suite.question = "q\n\"><script>";
  suite.scenes = {{"paper/one", "scenes/paper/one.yaml"}, {"paper/two", "scenes/paper/two.yaml"}};
  suite.systems = {BuiltIn("oracle"),
                   {.name = "mine",
                    .like = "",
                    .options = {},
                    .mask_errors = {},
                    .external = ExternalSystem{.command = "slam {output}", .timeout_s = 12.5}},
                   {.name = "network",
                    .like = "semantic",
                    .options = {{"feature.features", "0.1"}},
                    .mask_errors = {.boundary_px = 0.1, .latency_frames = 2},
                    .external = {}}};
  suite.twins = {"live", "empty"};
  suite.seeds = {3, 1, 18446744073709551615u};
  suite.limits = {
      {.score = "ate_rmse_m", .scene = "", .twin = "live", .system = "", .min = {}, .max = 0.1}};
  return plan;
}

TEST(PlanTest, ComesBackAsItWasWritten) {
  const std::string text = ToJson(Example());
  EXPECT_EQ(ToJson(PlanFromJson(text, "plan.json")), text);
  const PlanFile back = PlanFromJson(text, "plan.json");
  EXPECT_EQ(back.suites[0].systems, Example().suites[0].systems);
  EXPECT_EQ(back.name(), "x+second");
  EXPECT_THROW(PlanFromJson("{}", "plan.json"), InputError);
}

std::string NewInputs(const RunSpec& spec) { return "new inputs of " + RunId(spec); }

/// As a folder holds it that was planned at this hour for a part of the runs.
PlanFile Planned(const std::string& started, const Shard& part = {}) {
  PlanFile plan = Example();
  plan.started = started;
  for (const RunSpec& spec : TakeShard(Plan(plan.suites), part)) {
    plan.inputs.emplace(RunId(spec), NewInputs(spec));
  }
  return plan;
}

TEST(PlanTest, PartsAskOneQuestionWhoeverBeganWhenAndWithWhat) {
  const PlanFile one = Planned("2026-01-31T02:00:00Z", {1, 2});
  EXPECT_EQ(ToJson(PlanFromJson(ToJson(one), "plan.json")), ToJson(one));
  EXPECT_TRUE(SameQuestion(one, Planned("2026-01-31T02:00:07Z", {2, 2})));
  PlanFile other = one;
  other.gate = true;
  EXPECT_FALSE(SameQuestion(one, other));
}

TEST(PlanTest, ANightThatGoesOnBeganWhenItBegan) {
  const PlanFile before = Planned("yesterday"), now = Planned("today");
  EXPECT_EQ(ToJson(Resumed(now, before, NewInputs)), ToJson(before));
  // With more seeds: the new ones beside the old ones.
  PlanFile fewer = before;
  fewer.inputs.erase(fewer.inputs.begin());
  EXPECT_EQ(ToJson(Resumed(now, fewer, NewInputs)), ToJson(before));
}

TEST(PlanTest, TwoPartsInOneFolderAreBothMeantToBeThere) {
  const PlanFile first = Planned("yesterday", {1, 2});
  EXPECT_EQ(ToJson(Resumed(Planned("today", {2, 2}), first, NewInputs)),
            ToJson(Planned("yesterday")));
}

TEST(PlanTest, AnotherNightInTheSameFolderKeepsNothingOfTheLast) {
  const PlanFile now = Planned("today");
  PlanFile changed = Planned("yesterday");
  changed.inputs.begin()->second = "old inputs";
  PlanFile of_before = Planned("");
  of_before.inputs.clear();
  PlanFile strange = Planned("yesterday");
  strange.inputs = {{"another/live/plain/1", "x"}};
  for (const PlanFile& before : {changed, of_before, strange}) {
    EXPECT_EQ(ToJson(Resumed(now, before, NewInputs)), ToJson(now));
  }
}

/// Plans of before have no share, and are written as they were where a limit has none.
TEST(PlanTest, ALimitsShareIsKeptAndMayBeMissing) {
  PlanFile plan = Example();
  EXPECT_EQ(ToJson(plan).find("\"share\""), std::string::npos);
  EXPECT_FALSE(PlanFromJson(ToJson(plan), "plan.json").suites[0].limits[0].share);
  plan.suites[0].limits[0].share = 0.95;
  EXPECT_EQ(PlanFromJson(ToJson(plan), "plan.json").suites[0].limits[0].share, 0.95);
}

TEST(PlanTest, SuitesOfBareScenesAskOneQuestion) {
  PlanFile plan;
  const auto drive = [&](const std::string& name) {
    Suite& suite = plan.suites.emplace_back();
    suite.question = QuestionOfScenes({name});
    suite.scenes = {{name, name + ".yaml"}};
  };
  drive("drive/one");
  EXPECT_EQ(plan.question(), "How do the systems fare on drive/one?");
  drive("drive/two");
  EXPECT_EQ(plan.question(), "How do the systems fare on drive/one, drive/two?");
  drive("drive/three");
  drive("drive/four");
  EXPECT_EQ(plan.question(), "How do the systems fare on drive/one, drive/two and 2 more?");
  plan.suites.emplace_back().question = "Which one wins?";
  EXPECT_TRUE(plan.question().ends_with("drive/four? Which one wins?")) << plan.question();
}

TEST(ShardTest, PartsAreDisjointAndTogetherTheWholeAndShareNoFrames) {
  const std::vector<RunSpec> specs = Plan(Example().suites);
  for (std::size_t count = 1; count <= 15; ++count) {
    std::map<std::string, int> seen;
    std::map<std::string, std::size_t> owner_of_frames;
    for (std::size_t index = 1; index <= count; ++index) {
      for (const RunSpec& spec : TakeShard(specs, {index, count})) {
        ++seen[RunId(spec)];
        const std::string frames = fmt::format("{} {} {}", spec.scene, spec.twin, spec.seed);
        EXPECT_EQ(owner_of_frames.emplace(frames, index).first->second, index);
      }
    }
    EXPECT_EQ(seen.size(), specs.size());
    for (const auto& [id, times] : seen) EXPECT_EQ(times, 1) << id;
  }
}

TEST(ShardTest, IsWrittenAsPartOfWhole) {
  EXPECT_EQ(ShardFromText("2/3").index, 2u);
  for (const char* bad : {"", "1", "0/2", "3/2", "1/0", "a/b", "1/2/3", "-1/2", "1/ 2"}) {
    EXPECT_THROW(ShardFromText(bad), InputError) << bad;
  }
}

}  // namespace
}  // namespace aisle
