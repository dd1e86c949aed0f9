// Nights that share a folder or a report: what is tonight's, and when it began.
#include <gmock/gmock.h>

#include <set>

#include "harness/io/file.h"
#include "harness/io/file_lock.h"
#include "harness/record/history.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class PartsTest : public ProgramTest {
 protected:
  std::string RunFolder(const std::string& out, int seed) const {
    return Out(out) + "/runs/short/live/plain/" + std::to_string(seed);
  }
  /// When the nights of a suite began that stand among the trends.
  std::set<std::string> Nights(const std::string& suite) const {
    std::set<std::string> nights;
    for (const TrendPoint& point : ReadHistory(folder_ / "history.sqlite", suite)) {
      nights.insert(point.started);
    }
    return nights;
  }
};

TEST_F(PartsTest, WhatAnEarlierNightLeftIsNoRunOfTonights) {
  const std::string suite = Suite("left", "  - plain\n", "seeds: 2\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("a")}).code, 0);
  // Tonight the folder holds a part, and who was to make the other one died before its first run.
  ASSERT_EQ(Run({"run", suite, "--out", Out("a"), "--shard", "1/2"}).code, 0);
  ASSERT_EQ(Run({"run", suite, "--out", Out("b"), "--shard", "2/2"}).code, 0);
  fs::rename(Out("b") + "/runs", Out("made"));
  ASSERT_TRUE(fs::exists(RunFolder("a", 2) + "/result.json"));
  const Said half = Run({"merge", Out("whole"), Out("a"), Out("b")});
  EXPECT_EQ(half.code, 1) << half.text;
  EXPECT_THAT(half.text, HasSubstr("short/live/plain/2: completes: no result"));
  EXPECT_THAT(half.text, HasSubstr(RunFolder("a", 2) + ": left over from an earlier run"));
  EXPECT_FALSE(fs::exists(RunFolder("whole", 2)));

  fs::rename(Out("made"), Out("b") + "/runs");
  const Said both = Run({"merge", Out("whole"), Out("a"), Out("b")});
  EXPECT_EQ(both.code, 0) << both.text;
  // Of other inputs than the part's own plan says: it was made before the plan was.
  const fs::path result = RunFolder("b", 2) + "/result.json";
  std::string text = ReadFile(result);
  const std::string key = "\"inputs_hash\": \"";
  text.replace(text.find(key) + key.size(), 4, "zzzz");
  WriteFileAtomically(result, text);
  const Said stale = Run({"merge", Out("whole"), Out("a"), Out("b")});
  EXPECT_EQ(stale.code, 1) << stale.text;
  EXPECT_THAT(stale.text, HasSubstr(RunFolder("b", 2) + ": left over from an earlier run"));
  // Joined in a part's own folder, that part's leftovers answer no more than elsewhere.
  EXPECT_EQ(Run({"merge", Out("a"), Out("a"), Out("b")}).code, 1);
  EXPECT_EQ(ResultsOf(Out("a")).runs.size(), 1u);
}

TEST_F(PartsTest, ASceneEditedBetweenThePartsIsNoSceneOfOneNight) {
  const fs::path scene = folder_ / "scenes" / "short.yaml";
  WriteFileAtomically(scene, ReadFile(scene_));
  scene_ = scene.string();
  const std::string suite = Suite("edited", "  - plain\n", "seeds: 2\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("a"), "--shard", "1/2"}).code, 0);
  WriteFileAtomically(scene, ReadFile(scene) + "# a remark changes nothing that is seen\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("b"), "--shard", "2/2"}).code, 0);
  EXPECT_EQ(Run({"merge", Out("whole"), Out("a"), Out("b")}).code, 0);
  std::string changed = ReadFile(scene);
  const std::string exposure = "exposure_ms: 6";
  changed.replace(changed.find(exposure), exposure.size(), "exposure_ms: 9");
  WriteFileAtomically(scene, changed);
  ASSERT_EQ(Run({"run", suite, "--out", Out("b"), "--shard", "2/2"}).code, 0);
  const Said said = Run({"merge", Out("whole"), Out("a"), Out("b")});
  EXPECT_EQ(said.code, 4) << said.text;
  EXPECT_THAT(said.text, HasSubstr("was planned with another short than " + Out("a")));
}

TEST_F(PartsTest, BothPartsOneAfterTheOtherInOneFolderAreTheWhole) {
  const std::string suite = Suite("both", "  - plain\n", "seeds: 2\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("a"), "--shard", "1/2"}).code, 0);
  ASSERT_EQ(Run({"run", suite, "--out", Out("a"), "--shard", "2/2", "--resume"}).code, 0);
  const Said said = Run({"merge", Out("whole"), Out("a")});
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_EQ(ResultsOf(Out("whole")).runs.size(), 2u);
}

TEST_F(PartsTest, AMergeLeavesAFolderAloneInWhichSomebodyIsAtWork) {
  const std::string suite = Suite("busy", "  - plain\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("a")}).code, 0);
  ASSERT_EQ(Run({"run", suite, "--out", Out("whole")}).code, 0);
  const std::string before = ReadFile(Out("whole") + "/results.json");
  for (const char* busy : {"whole", "a"}) {
    const std::optional<FileLock> other = FileLock::Try(fs::path(Out(busy)) / ".lock");
    ASSERT_TRUE(other);
    const Said said = Run({"merge", Out("whole"), Out("a")});
    EXPECT_EQ(said.code, 4) << said.text;
    EXPECT_THAT(said.text, HasSubstr(Out(busy)));
    EXPECT_THAT(said.text, HasSubstr("in use by"));
    EXPECT_EQ(ReadFile(Out("whole") + "/results.json"), before);
  }
  EXPECT_EQ(Run({"merge", Out("whole"), Out("a")}).code, 0);
  EXPECT_EQ(Run({"merge", Out("whole"), Out("a"), Out("a"), Out("whole")}).code, 0);
}

TEST_F(PartsTest, ANightStandsOnceAmongTheTrendsHoweverOftenItIsToldOf) {
  const std::string suite = Suite("once", "  - {name: mine, like: plain}\n", "seeds: 2\n");
  const std::vector<std::string> resume{"run", suite, "--out", Out("a"), "--resume"};
  ASSERT_EQ(Run(resume).code, 0);
  EXPECT_THAT(Run(resume).text, HasSubstr("2 of 2 runs are already done"));
  const std::set<std::string> first = Nights("once");
  EXPECT_EQ(first.size(), 1u);
  EXPECT_TRUE(first.contains(ResultsOf(Out("a")).started));
  fs::remove_all(Out("a") + "/runs/short/live/mine/2");  // as if it had been killed
  ASSERT_EQ(Run(resume).code, 0);
  EXPECT_EQ(Nights("once"), first);
  // The same command on another system is a night of its own.
  Suite("once", "  - {name: mine, like: oracle}\n", "seeds: 2\n");
  EXPECT_THAT(Run(resume).text, Not(HasSubstr("already done")));
  EXPECT_EQ(Nights("once").size(), 2u);
}

/// The suite said in other words is a night of it; a part of its seeds, other systems or fewer
/// twins are not.
TEST_F(PartsTest, OnlyTheSuiteAsWrittenStandsAmongTheTrends) {
  const std::string suite =
      Suite("written", "  - plain\n  - oracle\n", "seeds: 2\ntwins: [live, empty]\n");
  const std::vector<std::string> trials[] = {
      {"--seeds", "1"},       {"--seeds", "3"},    {"--seed", "2"},
      {"--systems", "plain"}, {"--twins", "live"}, {"--set", "plain.feature.features=700"}};
  const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> line{"run", suite, "--no-video", "--out", Out(out)};
    line.insert(line.end(), more.begin(), more.end());
    const Said said = Run(line);
    EXPECT_EQ(said.code, 0) << said.text;
  };
  for (const std::vector<std::string>& trial : trials) {
    run("trial", trial);
    EXPECT_TRUE(Nights("written").empty()) << trial[0] << trial[1];
  }
  run("a", {});
  run("b", {"--seed", "2,1", "--systems", "oracle,plain"});
  run("c", {"--seeds", "2", "--twins", "empty,live,frozen"});
  EXPECT_EQ(Nights("written").size(), 3u);
}

TEST_F(PartsTest, AMergedNightBeganWithTheFirstOfItsParts) {
  const std::string suite = Suite("joined", "  - plain\n", "seeds: 2\n");
  std::set<std::string> began;
  for (const char* part : {"2", "1"}) {
    ASSERT_EQ(Run({"run", suite, "--out", Out(part), "--shard", std::string(part) + "/2"}).code, 0);
    began.insert(ResultsOf(Out(part)).started);
  }
  for (int i = 0; i < 2; ++i) ASSERT_EQ(Run({"merge", Out("whole"), Out("1"), Out("2")}).code, 0);
  EXPECT_EQ(Nights("joined"), std::set<std::string>{*began.begin()});
}

}  // namespace
}  // namespace aisle
