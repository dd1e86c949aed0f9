// The whole loop through the real program: render, drive, score, judge, report; killed, resumed,
// parted, merged and repeated.
#include <gmock/gmock.h>

#include <array>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "harness/io/file.h"
#include "harness/io/file_lock.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kTwo = "  - plain\n  - oracle\n";

class SuiteRunTest : public ProgramTest {};

TEST_F(SuiteRunTest, LeavesAReportThatOtherCommandsCanRead) {
  const Said said = Run({"run", Suite("whole", kTwo), "--out", Out("a")});
  ASSERT_EQ(said.code, 0) << said.text;
  for (const char* file :
       {"index.html", "style.css", "results.json", "summary.csv", "junit.xml", "plan.json"}) {
    EXPECT_TRUE(fs::exists(fs::path(Out("a")) / file)) << file;
  }
  const Results results = ResultsOf(Out("a"));
  ASSERT_EQ(results.runs.size(), 2u);
  for (const RunRecord& run : results.runs) {
    EXPECT_EQ(run.status, RunStatus::kOk) << run.status_why;
    EXPECT_EQ(run.frames, 12u);
    EXPECT_LT(*run.scores.at("ate_rmse_m").value, 0.05);
  }
  EXPECT_EQ(Run({"report", Out("a")}).code, 0);
  EXPECT_THAT(Run({"compare", Out("a"), Out("a")}).text, HasSubstr("same"));
}

TEST_F(SuiteRunTest, DrawingTheStagesChangesNoBitAndShowsThemInTheReport) {
  const std::string suite = Suite("drawn", "  - paper\n  - robust\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("plain")}).code, 0);
  const Said said = Run({"run", suite, "--out", Out("drawn"), "--debug-dynamic"});
  ASSERT_EQ(said.code, 0) << said.text;
  EXPECT_EQ(Bits(Out("drawn")), Bits(Out("plain")));
  for (const RunRecord& run : ResultsOf(Out("drawn")).runs) {
    const fs::path folder = fs::path(Out("drawn")) / "runs" / RunId(run.spec) / "stages";
    // Nothing can be seen of the first frame, which has no past.
    EXPECT_TRUE(fs::exists(folder / "000001.jpg")) << folder;
    EXPECT_TRUE(fs::exists(folder / "000011.jpg")) << folder;
  }
  EXPECT_FALSE(fs::exists(fs::path(Out("plain")) / "runs" /
                          RunId(ResultsOf(Out("plain")).runs.front().spec) / "stages"));
}

TEST_F(SuiteRunTest, SaysSoWhereVideosCannotBeMade) {
  const std::string suite = Suite("silent", "  - plain\n");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.c_str(), 1);
  const Said said = Run({"run", suite, "--out", Out("silent")});
  const Said unasked = Run({"run", suite, "--out", Out("unasked"), "--no-video"});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_THAT(said.text, HasSubstr("no videos of the runs: ffmpeg is not installed"));
  EXPECT_THAT(unasked.text, Not(HasSubstr("ffmpeg")));
}

TEST_F(SuiteRunTest, KilledAtAnyMomentAndResumedGivesTheSameBits) {
  const std::string suite = Suite("killed", kTwo, "seeds: 2\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("calm")}).code, 0);
  // Random moments, most of them early: before the first frame, inside runs, between them, while
  // the report is written. The program is killed by SIGKILL; its children die with it.
  std::mt19937_64 random(::testing::UnitTest::GetInstance()->random_seed());
  std::exponential_distribution<double> moment(1.0);
  std::vector<std::string> again{"run",         suite,      "--out",
                                 Out("killed"), "--resume", "--no-frame-cache"};
  int kills = 0;
  for (int i = 0; i < 10; ++i) {
    if (!Kill(again, 0.05 + moment(random))) break;
    ++kills;
  }
  EXPECT_GE(kills, 3);
  const Said said = Run(again);
  ASSERT_EQ(said.code, 0) << said.text;
  EXPECT_EQ(Bits(Out("killed")), Bits(Out("calm")));
  for (const auto& entry : fs::recursive_directory_iterator(Out("killed"))) {
    // What a killed writer left aside has a name nobody takes for a result.
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(!entry.is_regular_file() || name.front() == '.' || entry.file_size() > 0 ||
                name == "log.txt")
        << name;
  }
}

TEST_F(SuiteRunTest, ResumeTrustsContentsNotNames) {
  const std::string suite = Suite("trust", "  - plain\n");
  const std::vector<std::string> resume{"run", suite, "--out", Out("a"), "--resume"};
  ASSERT_EQ(Run({"run", suite, "--out", Out("a")}).code, 0);
  EXPECT_THAT(Run(resume).text, HasSubstr("1 of 1 runs are already done"));

  const fs::path run = fs::path(Out("a")) / "runs/short/live/plain/1";
  const std::string whole = ReadFile(run / "final.txt");
  WriteFileAtomically(run / "final.txt", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(Run(resume).text, testing::Not(HasSubstr("already done")));
  EXPECT_EQ(ReadFile(run / "final.txt"), whole);

  WriteFileAtomically(run / "result.json", "{\"scene\": 3");
  EXPECT_THAT(Run(resume).text, testing::Not(HasSubstr("already done")));

  // The same name, another scene.
  const std::string other = (folder_ / "elsewhere/scenes/short.yaml").string();
  std::string text = ReadFile(scene_);
  text.replace(text.find("height_m: 4.6"), 13, "height_m: 4.1");
  WriteFileAtomically(other, text);
  std::string moved = ReadFile(suite);
  moved.replace(moved.find(scene_), scene_.size(), other);
  WriteFileAtomically(suite, moved);
  EXPECT_THAT(Run(resume).text, testing::Not(HasSubstr("already done")));
  EXPECT_NE(ReadFile(run / "final.txt"), whole);
}

TEST_F(SuiteRunTest, ADryRunOfANightThatGoesOnTellsWhatIsLeftAndTakesNothing) {
  const std::string suite = Suite("rest", "  - plain\n");
  const auto ahead = [&](const std::string& seeds) {
    return Run({"run", suite, "--out", Out("a"), "--seeds", seeds, "--resume", "--dry-run"}).text;
  };
  EXPECT_THAT(ahead("1"), HasSubstr("aisle: 1 run: "));
  ASSERT_EQ(Run({"run", suite, "--out", Out("a")}).code, 0);
  const std::string result = ReadFile(fs::path(Out("a")) / "runs/short/live/plain/1/result.json");
  const std::string whole = ahead("1");
  EXPECT_THAT(whole, HasSubstr("1 of 1 runs are already done"));
  EXPECT_THAT(whole, testing::Not(HasSubstr("stereo pairs")));
  const std::string rest = ahead("3");
  EXPECT_THAT(rest, HasSubstr("1 of 3 runs are already done"));
  EXPECT_THAT(rest, HasSubstr("2 runs: 1 scene, 1 twin, 1 system, 2 seeds; "));
  // What it would make anew lies there until it does.
  WriteFileAtomically(fs::path(Out("a")) / "runs/short/live/plain/1/final.txt", "spoilt");
  EXPECT_THAT(ahead("1"), HasSubstr("aisle: 1 run: "));
  EXPECT_EQ(ReadFile(fs::path(Out("a")) / "runs/short/live/plain/1/result.json"), result);
}

TEST_F(SuiteRunTest, AHistoryThatCannotBeWrittenIsSaidInTheEveningAndCostsNoReport) {
  const std::string suite = Suite("trends", "  - plain\n");
  WriteFileAtomically(folder_ / "history.sqlite", std::string(5000, 'x'));
  const Said said = Run({"run", suite, "--out", Out("a")});
  EXPECT_EQ(said.code, 3) << said.text;
  const std::size_t warned = said.text.find("warning: the trends will not include this run");
  EXPECT_LT(warned, said.text.find("[1/1]")) << said.text;
  EXPECT_THAT(said.text, HasSubstr("the trends will not include this run"));
  EXPECT_THAT(ReadFile(fs::path(Out("a")) / "index.html"),
              HasSubstr("The trends do not include this run: "));
  EXPECT_EQ(ResultsOf(Out("a")).runs.size(), 1u);
}

TEST_F(SuiteRunTest, ABaselineThatIsNoneIsSaidBeforeTheNight) {
  const std::string suite = Suite("gated", "  - plain\n"), baseline = Out("baseline.json");
  for (const char* text : {"", "{\"schema\": 1, \"runs\": [", "[1]", "{\"schema\": 1}"}) {
    WriteFileAtomically(baseline, text);
    const Said said = Run({"run", suite, "--out", Out("a"), "--gate", "--baseline", baseline});
    EXPECT_EQ(said.code, 4) << said.text;
    EXPECT_THAT(said.text, HasSubstr("baseline.json: not a results file"));
    EXPECT_FALSE(fs::exists(Out("a")));
  }
}

TEST_F(SuiteRunTest, ANightThatCanOnlyFailAtTheGateDoesNotBegin) {
  const std::string two = Suite("gate", "  - plain\n", "seeds: 2\n");
  ASSERT_EQ(Run({"run", two, "--out", Out("good")}).code, 0);
  const std::string baseline = Out("good") + "/results.json";
  for (const char* more : {"--dry-run", "--no-video"}) {
    const Said said = Run({"run", Suite("gate", "  - plain\n"), "--out", Out("a"), "--gate",
                           "--baseline", baseline, more});
    EXPECT_EQ(said.code, 4) << said.text;
    EXPECT_THAT(said.text, HasSubstr("--gate: of the baseline 1 seed of 1 cell is missing"));
    EXPECT_THAT(said.text, HasSubstr("Run them with --seeds 2"));
    EXPECT_FALSE(fs::exists(Out("a")));
  }
}

TEST_F(SuiteRunTest, ScoresThatAMaskTakesAwayFailTheGate) {
  // Who misses everything has no precision any more: the score is gone, which is no pass.
  const auto network = [](const char* share) {
    return fmt::format("  - {{name: network, like: oracle, mask_errors: {{miss_share: {}}}}}\n",
                       share);
  };
  ASSERT_EQ(Run({"run", Suite("gate", network("0")), "--out", Out("good")}).code, 0);
  const std::string baseline = Out("good") + "/results.json";
  ASSERT_TRUE(ResultsOf(Out("good")).runs[0].scores.at("mask_precision").value);
  const Said same = Run(
      {"run", Suite("gate", network("0")), "--out", Out("same"), "--gate", "--baseline", baseline});
  EXPECT_EQ(same.code, 0) << same.text;
  const Said blind = Run({"run", Suite("gate", network("1")), "--out", Out("blind"), "--gate",
                          "--baseline", baseline});
  EXPECT_EQ(blind.code, 1) << blind.text;
  EXPECT_THAT(blind.text, HasSubstr("gone: "));
}

TEST_F(SuiteRunTest, TwoScenesThatWouldShareTheirNameAreRefused) {
  for (const char* file : {"x/mini.yaml", "y/mini.yaml"}) {
    WriteFileAtomically(folder_ / file, ReadFile(scene_));
  }
  WriteFileAtomically(folder_ / "s.yaml",
                      "suite: s\nquestion: q\nscenes: [x/mini.yaml, y/mini.yaml]\n"
                      "systems: [plain]\nseeds: 1\n");
  const Said said = Run({"run", (folder_ / "s.yaml").string(), "--out", Out("a")});
  EXPECT_EQ(said.code, 4) << said.text;
  EXPECT_THAT(said.text, HasSubstr("y/mini.yaml would both be named 'mini'"));
  EXPECT_FALSE(fs::exists(Out("a")));
}

TEST_F(SuiteRunTest, TwoNightsDoNotShareAFolder) {
  const std::string suite = Suite("taken", "  - plain\n");
  const std::optional<FileLock> other = FileLock::Try(fs::path(Out("a")) / ".lock");
  ASSERT_TRUE(other);
  const Said said = Run({"run", suite, "--out", Out("a")});
  EXPECT_EQ(said.code, 4) << said.text;
  EXPECT_THAT(said.text, HasSubstr("in use by another `aisle run`"));
}

TEST_F(SuiteRunTest, ThreeNightsAtOnceShareACache) {
  // Frames and a dataset that nobody has made yet: all three set about it.
  const std::string suite =
      Suite("shared", "  - plain\n  - {name: lists, command: \"ls -R {dataset} # {output}\"}\n",
            "seeds: [77]\n");
  std::vector<std::thread> nights;
  std::array<Said, 3> said;
  for (std::size_t i = 0; i < said.size(); ++i) {
    nights.emplace_back([&, i] {
      said[i] = Run({"run", suite, "--no-retry", "--out", Out(fmt::format("n{}", i))});
    });
  }
  for (std::thread& night : nights) night.join();
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_EQ(said[i].code, 1) << said[i].text;  // one leaves no trajectory
    EXPECT_EQ(Bits(Out(fmt::format("n{}", i))), Bits(Out("n0")));
  }
}

TEST_F(SuiteRunTest, PartsMergeIntoTheWhole) {
  const std::string suite =
      Suite("parts", kTwo, "seeds: 2\nlimits:\n  - {score: ate_rmse_m, max: 0.05}\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("whole")}).code, 0);
  ASSERT_EQ(Run({"run", suite, "--out", Out("one"), "--shard", "1/2"}).code, 0);
  EXPECT_EQ(ResultsOf(Out("one")).runs.size(), 2u);
  const Said half = Run({"merge", Out("merged"), Out("one")});
  EXPECT_EQ(half.code, 1);  // two runs are missing, and silence is no pass
  EXPECT_THAT(half.text, HasSubstr("no result"));
  ASSERT_EQ(Run({"run", suite, "--out", Out("two"), "--shard", "2/2"}).code, 0);
  const Said said = Run({"merge", Out("merged"), Out("one"), Out("two")});
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_EQ(Bits(Out("merged")), Bits(Out("whole")));
  EXPECT_EQ(ResultsOf(Out("merged")).verdicts.size(), ResultsOf(Out("whole")).verdicts.size());
}

TEST_F(SuiteRunTest, AMergeHoldsNothingOfAnEarlierOne) {
  const std::string suite = Suite("stale", "  - plain\n", "seeds: 2\n");
  for (const char* part : {"1", "2"}) {
    ASSERT_EQ(Run({"run", suite, "--out", Out(part), "--shard", std::string(part) + "/2"}).code, 0);
  }
  ASSERT_EQ(Run({"run", suite, "--out", Out("trial"), "--seed", "1"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "history.sqlite")) << "neither parts nor trials are nights";
  ASSERT_EQ(Run({"merge", Out("merged"), Out("1"), Out("2")}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "history.sqlite"));
  fs::remove_all(fs::path(Out("2")) / "runs");  // the second night was killed at once
  const Said said = Run({"merge", Out("merged"), Out("1"), Out("2")});
  EXPECT_EQ(said.code, 1) << said.text;
  EXPECT_THAT(said.text, HasSubstr("no result"));
  EXPECT_EQ(ResultsOf(Out("merged")).runs.size(), 1u);
}

TEST_F(SuiteRunTest, PartsOfTwoProgramsAreNotMerged) {
  const std::string suite = Suite("programs", "  - plain\n", "seeds: 2\n");
  for (const char* part : {"1", "2"}) {
    ASSERT_EQ(Run({"run", suite, "--out", Out(part), "--shard", std::string(part) + "/2"}).code, 0);
  }
  const RunRecord made = ResultsOf(Out("2")).runs.at(0);
  EXPECT_FALSE(made.program.empty());
  const auto pretend = [&](const std::string& program, const std::string& commit,
                           const std::string& cpu) {
    RunRecord record = made;
    record.program = program;
    record.commit = commit;
    record.cpu = cpu;
    WriteFileAtomically(fs::path(Out("2")) / "runs" / RunId(made.spec) / "result.json",
                        ToJson(record));
  };
  pretend("another", "another", made.cpu);
  const Said other = Run({"merge", Out("merged"), Out("1"), Out("2")});
  EXPECT_EQ(other.code, 4) << other.text;
  EXPECT_THAT(other.text, HasSubstr("was made by another program (commit another)"));
  EXPECT_FALSE(fs::exists(fs::path(Out("merged")) / "results.json"));

  // The machines that made the runs are told, not the one that joins them.
  pretend(made.program, made.commit, "A processor of others");
  ASSERT_EQ(Run({"merge", Out("merged"), Out("1"), Out("2")}).code, 0);
  const Results merged = ResultsOf(Out("merged"));
  EXPECT_THAT(merged.provenance.cpu, HasSubstr("A processor of others"));
  EXPECT_THAT(merged.provenance.cpu, HasSubstr(made.cpu));
  EXPECT_EQ(merged.runs.at(0).cpu, made.cpu);
  EXPECT_EQ(merged.runs.at(1).cpu, "A processor of others");
  const Said again = Run({"rerun", RunId(made.spec), "--in", Out("merged"), "--json"});
  EXPECT_THAT(again.text, HasSubstr("\"same_processor\": false"));
}

TEST_F(SuiteRunTest, TheGateIsHeldAgainstTheWholeNotItsParts) {
  const auto network = [](const char* share) {
    return fmt::format("  - {{name: network, like: oracle, mask_errors: {{miss_share: {}}}}}\n",
                       share);
  };
  const char* seeds = "seeds: 2\n";
  ASSERT_EQ(Run({"run", Suite("gate", network("0"), seeds), "--out", Out("good")}).code, 0);
  const std::string baseline = Out("good") + "/results.json";
  for (const char* share : {"0", "1"}) {
    const std::string suite = Suite("gate", network(share), seeds);
    for (const char* part : {"1", "2"}) {
      const Said said = Run({"run", suite, "--out", Out(part), "--shard", std::string(part) + "/2",
                             "--gate", "--baseline", baseline});
      EXPECT_EQ(said.code, 0) << said.text;
    }
    const Said merged = Run({"merge", Out("merged"), Out("1"), Out("2")});
    EXPECT_EQ(merged.code, share == std::string("0") ? 0 : 1) << merged.text;
    EXPECT_EQ(merged.text.find("gone: ") != std::string::npos, share == std::string("1"));
  }
  fs::remove(fs::path(Out("2")) / "baseline.json");
  const Said without = Run({"merge", Out("merged"), Out("1"), Out("2")});
  EXPECT_EQ(without.code, 4) << without.text;
  EXPECT_THAT(without.text, HasSubstr("baseline.json: missing: the report was run with --gate"));
}

TEST_F(SuiteRunTest, BisectCallsNoCommitGoodThatItCouldNotDrive) {
  const std::string repository = (folder_ / "mine").string();
  fs::create_directories(repository);
  const std::string commit =
      "git -c user.name=a -c user.email=a@b commit -q --allow-empty -m change";
  ASSERT_EQ(
      std::system(fmt::format("cd '{}' && git init -q && {} && git tag v1 && {} && git tag v2",
                              repository, commit, commit)
                      .c_str()),
      0);
  const std::string suite = Suite(
      "mine", fmt::format("  - {{name: mine, command: 'sh {{source}}/slam {{output}}', repository: "
                          "{}, build: 'true'}}\n",
                          repository));
  const std::string cache = std::getenv("AISLE_CACHE");
  WriteFileAtomically(folder_ / "full", "no folder: nothing can be kept there");
  ::setenv("AISLE_CACHE", (folder_ / "full").c_str(), 1);
  const Said said = Run({"bisect", "v1", "v2", suite, "--scene", "short", "--limit", "completes",
                         "--out", Out("bisect")});
  ::setenv("AISLE_CACHE", cache.c_str(), 1);
  EXPECT_EQ(said.code, 3) << said.text;
  EXPECT_THAT(said.text, HasSubstr("the runs could not be made"));
  EXPECT_THAT(said.text, testing::Not(HasSubstr("good")));
}

/// A system that stands still, for its first commit; the second one says nothing.
TEST_F(SuiteRunTest, BisectNamesEveryCommitInFull) {
  const fs::path repository = folder_ / "mine";
  const auto commit = [&](const std::string& tag, const std::string& script) {
    WriteFileAtomically(repository / "slam", script);
    const std::string line = fmt::format(
        "cd '{}' && git init -q && git add slam && git -c user.name=a -c user.email=a@b commit -qm "
        "{} && git tag {}",
        repository.string(), tag, tag);
    ASSERT_EQ(std::system(line.c_str()), 0);
  };
  commit("v1",
         "awk -F, '!/#/ { printf \"%.9f 0 0 0 0 0 0 1\\n\", $1 / 1e9 }' "
         "\"$1/mav0/cam0/data.csv\" > \"$2\"\n");
  commit("v2", "exit 1\n");
  const std::string suite = Suite(
      "mine", fmt::format("  - {{name: mine, command: 'sh {{source}}/slam {{dataset}} {{output}}', "
                          "repository: {}, build: 'true'}}\n",
                          repository.string()));
  const Said said = Run({"bisect", "v1", "v2", suite, "--scene", "short", "--limit", "completes",
                         "--out", Out("bisect"), "--json"});
  ASSERT_EQ(said.code, 0) << said.text;
  const std::size_t begin = said.text.find('{'), end = said.text.rfind('}') + 1;
  const auto trials = nlohmann::json::parse(said.text.substr(begin, end - begin)).at("trials");
  EXPECT_EQ(trials.size(), 2u);
  for (const nlohmann::json& trial : trials) {
    EXPECT_THAT(trial.at("commit").get<std::string>(), testing::MatchesRegex("[0-9a-f]{40}"));
  }
}

TEST_F(SuiteRunTest, ANightThatDoesNotEndLeavesNoReportOfTheLast) {
  ASSERT_EQ(Run({"run", Suite("green", "  - plain\n"), "--out", Out("a")}).code, 0);
  const std::string longer = Suite("green", "  - plain\n", "seeds: 40\n");
  ASSERT_TRUE(Kill({"run", longer, "--out", Out("a")}, 3));
  for (const char* file :
       {"results.json", "junit.xml", "summary.txt", "summary.csv", "index.html"}) {
    EXPECT_FALSE(fs::exists(fs::path(Out("a")) / file)) << file;
  }
  EXPECT_EQ(Run({"report", Out("a")}).code, 4);
}

TEST_F(SuiteRunTest, OneDriveAnswersForEqualRuns) {
  // Another actor in the same hall: without actors the two are one.
  const std::string other = (folder_ / "scenes/other.yaml").string();
  std::string text = ReadFile(scene_);
  const std::size_t pace = text.find("speed_mps: 1.1");
  ASSERT_NE(pace, std::string::npos);
  WriteFileAtomically(other, text.replace(pace, 14, "speed_mps: 0.8"));
  const std::string suite = Suite("twice",
                                  "  - plain\n  - robust\n  - {name: shows, command: \"ls "
                                  "{dataset} # {output}\", depends_on: [/bin/ls]}\n",
                                  "seeds: 1\ntwins: [live, empty]\n");
  std::string both = ReadFile(suite);
  both.replace(both.find(scene_), scene_.size(), scene_ + ", " + other);
  WriteFileAtomically(suite, both);
  const Said said = Run({"run", suite, "--no-retry", "--out", Out("both")});
  EXPECT_EQ(said.code, 1) << said.text;  // the foreign one leaves no trajectory
  EXPECT_THAT(said.text, HasSubstr("12 runs"));
  EXPECT_THAT(said.text, HasSubstr("2 answered by another of equal inputs"));
  EXPECT_THAT(said.text, HasSubstr("other/empty/robust/1  as short/empty/robust/1"));
  EXPECT_THAT(said.text, testing::Not(HasSubstr("other/empty/shows/1  as")));
  EXPECT_THAT(said.text, testing::Not(HasSubstr("other/live/robust/1  as")));

  const std::string ours = "plain,robust";
  ASSERT_EQ(Run({"run", other, "--systems", ours, "--twins", "empty", "--out", Out("alone")}).code,
            0);
  const auto bits = Bits(Out("both")), alone = Bits(Out("alone"));
  for (const char* id : {"other/empty/plain/1", "other/empty/robust/1"}) {
    EXPECT_EQ(bits.at(id), alone.at(id)) << id;
  }
  for (const RunRecord& run : ResultsOf(Out("both")).runs) {
    for (const auto& [name, path] : run.artifacts) {
      EXPECT_TRUE(path.starts_with("runs/" + RunId(run.spec) + "/")) << path;
      EXPECT_TRUE(fs::exists(fs::path(Out("both")) / path)) << path;
    }
  }
  EXPECT_EQ(Run({"rerun", "other/empty/plain/1", "--in", Out("both")}).code, 0);

  // What was lost of it is not driven again either.
  fs::remove_all(fs::path(Out("both")) / "runs/other/empty/plain/1");
  const Said resumed = Run({"run", suite, "--no-retry", "--out", Out("both"), "--resume"});
  EXPECT_THAT(resumed.text, HasSubstr("12 of 12 runs are already done"));
  EXPECT_EQ(Bits(Out("both")), bits);
}

TEST_F(SuiteRunTest, OneRunIsRepeatedToTheLastBit) {
  const std::string suite = Suite("again", "  - robust\n");
  ASSERT_EQ(Run({"run", suite, "--out", Out("a"), "--threads", "2"}).code, 0);
  const Said said = Run({"rerun", "short/live/robust/1", "--in", Out("a"), "--threads", "1"});
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_THAT(said.text, HasSubstr("identical to the last bit"));
  const Said unknown = Run({"rerun", "short/live/best/1", "--in", Out("a")});
  EXPECT_EQ(unknown.code, 4);
  EXPECT_THAT(unknown.text, HasSubstr("no run 'short/live/best/1'; it has\n"));
}

}  // namespace
}  // namespace aisle
