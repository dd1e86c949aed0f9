#include "harness/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/judge/gate.h"
#include "harness/judge/limit.h"
#include "harness/report/allure.h"
#include "harness/report/console.h"
#include "harness/report/junit.h"
#include "harness/report/summary_text.h"
#include "tests/harness/record/night.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ReportTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_report_{}", ::getpid());
    if (const char* kept = std::getenv("AISLE_TEST_REPORT_DIR")) folder_ = kept;
  }
  void TearDown() override {
    if (std::getenv("AISLE_TEST_REPORT_DIR") == nullptr) fs::remove_all(folder_);
  }

  Results Make(const std::vector<RunResult>& runs, const std::vector<Limit>& limits) {
    Results results;
    results.provenance = {"0.1.0", "abc1234", "some processor", "Debian", 2};
    results.suite = "quickstart";
    results.question = "Does a person close in front spoil the pose?";
    results.started = "2026-01-31T02:00:00Z";
    results.rerun = "./aisle run scenes/suites/quickstart.yaml";
    results.wall_s = 123.4;
    for (const RunResult& run : runs) {
      const RunScore score = ScoreRun(run);
      RunRecord record = MakeRecord(run, score, 20);
      const std::string folder = "runs/" + RunId(run.spec);
      WriteImage(folder_ / folder / "frame_000001.jpg", cv::Mat1b(504, 752, (unsigned char)90));
      record.artifacts["picture_00"] = folder + "/frame_000001.jpg";
      results.runs.push_back(WriteRun(run, score, record, folder_));
    }
    results.verdicts = Judge(results.runs, limits);
    return results;
  }
  std::string Read(const std::string& name) const { return ReadFile(folder_ / name); }

  fs::path folder_;
};

const Limit kTight{
    .score = "ate_rmse_m", .scene = "", .twin = "live", .system = "oracle", .min = {}, .max = 0.02};
const Limit kBroken{
    .score = "ate_rmse_m", .scene = "", .twin = "", .system = "orbslam2", .min = {}, .max = 0.02};

TEST_F(ReportTest, AChartWithoutItsFramesSaysWhy) {
  const Results results = Make({MakeRun("paper/scene2", "oracle", 1, 0.02)}, {});
  WriteFileAtomically(folder_ / results.runs[0].artifacts.at("frames"), "frame,state\n7,lost\n");
  WriteReport(results, folder_);
  EXPECT_THAT(Read("index.html"), HasSubstr("oracle is not in the charts: "));
  EXPECT_THAT(Read("index.html"), HasSubstr("no column stamp_ns: made by another version"));
}

TEST_F(ReportTest, OfASystemThatIsDrawnTheSeedIsNamedThatIsNot) {
  const Results results = Make(
      {MakeRun("paper/scene2", "oracle", 1, 0.02), MakeRun("paper/scene2", "oracle", 2, 0.02)}, {});
  WriteFileAtomically(folder_ / results.runs[1].artifacts.at("frames"), "frame,state\n7,lost\n");
  WriteReport(results, folder_);
  EXPECT_THAT(Read("index.html"), HasSubstr("oracle, seed 2, is not in the charts: "));
  EXPECT_THAT(Read("index.html"), Not(HasSubstr("oracle is not in the charts: ")));
}

std::string Between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  EXPECT_NE(begin, std::string::npos) << from;
  return begin == std::string::npos ? "" : text.substr(begin, text.find(to, begin) - begin);
}

/// A seed that crashed before its first frame has nothing to say: what the others say stays.
TEST_F(ReportTest, ACrashOfTheFirstSeedTakesNothingFromTheOthers) {
  const auto page = [&](bool crashes) {
    std::vector<RunResult> runs;
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
      runs.push_back(MakeRun("paper/scene2", "oracle", seed, 0.02));
    }
    if (crashes) {
      runs[0].status = RunStatus::kCrashed;
      runs[0].facts.clear();
      runs[0].estimates.clear();
      runs[0].trajectory = {};
    }
    Results results = Make(runs, {});
    for (RunRecord& run : results.runs) {
      const auto step = run.scores.find("ms_process_mean");
      if (step != run.scores.end()) step->second.basis = "its wall time";
    }
    WriteReport(results, folder_);
    return Read("index.html");
  };
  const std::string good = page(false), crashed = page(true);
  for (const char* part :
       {"aria-label=\"time per frame by stage\"", "<p class=\"soft small\">300 f"}) {
    EXPECT_EQ(Between(crashed, part, "\n<"), Between(good, part, "\n<")) << part;
  }
  EXPECT_THAT(Between(good, "aria-label=\"time per frame by stage\"", "</figure>"),
              HasSubstr("extract 15.00 ms"));
  EXPECT_EQ(Between(crashed, "aria-label=\"time per frame by stage\"", "</figure>"),
            Between(good, "aria-label=\"time per frame by stage\"", "</figure>"));
  EXPECT_THAT(good, HasSubstr("<td>≈35.0"));
  EXPECT_THAT(crashed, HasSubstr("<td>≈35.0"));
  EXPECT_THAT(crashed, HasSubstr(" in 8 of 9 seeds.</p>"));
}

/// Failed is what did not come to its end, lost what did with too few poses: in every place alike.
TEST_F(ReportTest, FailedAndLostAreCountedAlikeEverywhere) {
  std::vector<RunResult> runs;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    runs.push_back(MakeRun("paper/scene2", "oracle", seed, 0.02));
  }
  runs[1].status = RunStatus::kLost;
  const std::string lost = "1 of 9 runs lost", both = "1 of 9 runs failed, 1 lost";
  for (const std::string& words : {lost, both}) {
    if (words == both) runs[2].status = RunStatus::kCrashed;
    const Results results = Make(runs, {});
    WriteReport(results, folder_);
    const std::string page = Read("index.html");
    EXPECT_THAT(Between(page, "<strong>", "</strong>"), HasSubstr(words));
    EXPECT_THAT(Between(page, "<ul class=\"answer\">", "</ul>"), HasSubstr("; " + words + ": "));
    EXPECT_THAT(Read("summary.txt"), HasSubstr(", " + words + "\n"));
    EXPECT_THAT(Between(page, "id=\"errors\"", "</table>"),
                HasSubstr(words == both ? "7/9 ok, 1 lost" : "8/9 ok, 1 lost"));
    const auto failed = std::count_if(results.runs.begin(), results.runs.end(),
                                      [](const auto& r) { return !IsComplete(r.status); });
    EXPECT_THAT(Read("junit.xml"), HasSubstr(fmt::format("failures=\"{}\"", failed)));
  }
}

/// What is to be pasted into a shell is its words, whatever the folder is called.
TEST_F(ReportTest, CommandsAreQuotedForAShell) {
  const Results results = Make({MakeRun("s", "orbslam2", 1, 0.6)}, {kBroken});
  WriteReport(results, folder_ / "my night");
  EXPECT_THAT(ReadFile(folder_ / "my night/index.html"),
              HasSubstr(fmt::format("rerun s/live/orbslam2/1 --in &#39;{}/my night&#39;</code>",
                                    folder_.string())));
  EXPECT_THAT(ToJunit(results, "out/my night"), HasSubstr("--in 'out/my night'\n"));
}

/// A link leads to one place only, however long the names are that make its id.
TEST_F(ReportTest, EveryIdOfThePageIsThereOnce) {
  std::vector<RunResult> runs;
  for (const char* twin : {"live", "empty"}) {
    runs.push_back(MakeRun("a/" + std::string(78, 'x'), "orbslam2", 1, 0.6));
    runs.back().spec.twin = twin;
  }
  WriteReport(Make(runs, {}), folder_);
  const std::string page = Read("index.html");
  std::map<std::string, int> times;
  for (std::size_t at = 0; (at = page.find(" id=\"", at)) != std::string::npos;) {
    at += std::string(" id=\"").size();
    ++times[page.substr(at, page.find('"', at) - at)];
  }
  EXPECT_GT(times.size(), 8u);
  for (const auto& [id, count] : times) EXPECT_EQ(count, 1) << id;
}

TEST_F(ReportTest, ThePageTellsTheVerdictFirst) {
  WriteReport(Make({MakeRun("paper/scene2", "orbslam2", 1, 0.6),
                    MakeRun("paper/scene2", "oracle", 1, 0.02)},
                   {kTight, kBroken}),
              folder_);
  const std::string page = Read("index.html");
  EXPECT_THAT(page, HasSubstr("1 of 2 verdicts failed (limits on 1 score, in 2 cells)"));
  EXPECT_THAT(page, HasSubstr("href=\"paper.html\""));
  EXPECT_LT(page.find("verdicts failed"), page.find("paper.html"));
  EXPECT_THAT(Read("paper.html"), HasSubstr("Absolute trajectory error"));
  EXPECT_THAT(page, HasSubstr(">paper/scene2 live orbslam2: ate_rmse_m</a>: value 0.0"));
  EXPECT_THAT(page, HasSubstr("<code>./aisle rerun paper.scene2/live/orbslam2/1 --in "));
}

TEST_F(ReportTest, WhoReadsTheTablesElsewhereLearnsWhichPaperTheySpeakOf) {
  WriteReport(Make({MakeRun("paper/scene2", "oracle", 1, 0.02)}, {}), folder_);
  for (const char* file : {"tables.md", "tables.tex", "paper.html"}) {
    EXPECT_THAT(Read(file), HasSubstr("Robust Stereo Visual SLAM for Dynamic Environments"))
        << file;
  }
}

TEST_F(ReportTest, WhatTheSystemsAreIsSaidOnThePage) {
  RunResult variant = MakeRun("s", "quick", 1, 0.02);
  variant.spec.system.like = "robust";
  variant.spec.system.options = {{"feature.features", "800"}};
  const Results results = Make({MakeRun("s", "plain", 1, 0.02), variant}, {});
  WriteReport(results, folder_, {.systems = {{"plain", "without rejection"}, {"robust", "a & b"}}});
  EXPECT_THAT(Read("index.html"), HasSubstr("<td class=\"wrap\">without rejection\n"));
  EXPECT_THAT(Read("index.html"), HasSubstr("like robust (a &amp; b), feature.features 800"));
}

/// Somebody walks by for three seconds, of whom the system loses sight for four frames in ten.
RunResult WithAWalker(RunResult run) {
  for (std::size_t i = 20; i < 80; ++i) {
    ObjectOutcome walker;
    walker.share = 0.02;
    walker.speed_mps = 1.2;
    walker.rejected = i % 10 < 6 ? 1 : 0;
    run.facts[i].mask->objects.push_back(walker);
  }
  return run;
}

TEST_F(ReportTest, AScenesPageTellsHowItsMoversWereFollowed) {
  const RunResult oracle = WithAWalker(MakeRun("paper/scene2", "oracle", 1, 0.02));
  const Results results = Make({MakeRun("paper/scene2", "orbslam2", 1, 0.6), oracle}, {});
  EXPECT_EQ(results.runs[1].scores.at("mover_large_gap_max_frames").value, 4);
  WriteReport(results, folder_);
  const std::string page = Read("index.html");
  const auto table = page.find("How movers were followed");
  ASSERT_NE(table, std::string::npos);
  const std::string rows = page.substr(table, page.find("</table>", table) - table);
  EXPECT_THAT(rows, HasSubstr("</span>oracle<td>100.0<td>0.00<td>0.00<td>4\n"));
  EXPECT_THAT(rows, Not(HasSubstr("</span>orbslam2")));  // it rejects nothing
  EXPECT_THAT(rows, Not(HasSubstr("slow")));             // nobody creeps
}

/// A foreign system that crashed, and what it said.
RunResult Crashed(const std::string& words) {
  RunResult run = MakeRun("paper/scene2", "mine", 1, 0.1);
  run.spec.system = {.name = "mine", .external = ExternalSystem{.command = words}};
  run.status = RunStatus::kCrashed;
  run.status_why = "exit code 134: signal 6, SIGABRT (Aborted); last words: " + words;
  run.last_words = words + "\n";
  run.system_version = words;
  run.trajectory = {};
  return run;
}

TEST_F(ReportTest, ABoundThatSaysNothingIsNotSaid) {
  for (const int good : {0, 1, 7}) {
    std::vector<RunResult> runs(8, Crashed("boom"));
    for (std::size_t i = 0; i < runs.size(); ++i) {
      runs[i].spec.seed = i + 1;
      if (static_cast<int>(i) < good) runs[i].status = RunStatus::kOk;
    }
    WriteReport(Make(runs, {}), folder_);
    const std::string said = Between(Read("index.html"), "crashed, hung or answered nonsense", "<");
    EXPECT_EQ(said.find("e+"), std::string::npos) << said;
    EXPECT_EQ(said.find("95 % sure") == std::string::npos, good == 0) << said;
  }
}

TEST_F(ReportTest, ANightThatCrashedIsRedWithoutAnyLimit) {
  Results results = Make({MakeRun("paper/scene2", "oracle", 1, 0.02), Crashed("boom")}, {});
  results.verdicts.clear();
  WriteReport(results, folder_);
  const std::string page = Read("index.html");
  EXPECT_THAT(page, HasSubstr("<div class=\"verdict failed\"><strong>1 of 2 runs failed"));
  EXPECT_THAT(page, HasSubstr("<pre>boom\n</pre>"));
}

TEST_F(ReportTest, ACellShowsTheMedianOfThoseThatCameToAnEnd) {
  std::vector<RunResult> runs;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    runs.push_back(MakeRun("paper/scene2", "oracle", seed, 0.02));
  }
  runs.back().status = RunStatus::kCrashed;
  runs.back().trajectory = {};
  WriteReport(Make(runs, {}), folder_);
  const std::string page = Read("index.html");
  const auto errors = page.find("id=\"errors\"");
  const std::string table = page.substr(errors, page.find("</table>", errors) - errors);
  EXPECT_THAT(table, HasSubstr("<span class=\"fail\">2/3 ok</span>"));
  EXPECT_THAT(table, Not(HasSubstr(">- ")));
}

TEST_F(ReportTest, WhatAForeignSystemSaysIsHarmlessWhereverItIsQuoted) {
  const std::string hostile = "</pre><script>alert(1)</script>]]>&\x1b[31m\xff";
  const Results results = Make({MakeRun("paper/scene2", "oracle", 1, 0.02), Crashed(hostile)}, {});
  WriteReport(results, folder_);
  WriteAllure(results, folder_, folder_ / "allure");
  for (const char* name : {"index.html", "paper.html"}) {
    EXPECT_THAT(Read(name), Not(HasSubstr("<script>"))) << name;
  }
  EXPECT_EQ(Read("summary.txt").find('\x1b'), std::string::npos);
  pugi::xml_document junit;
  EXPECT_TRUE(junit.load_string(Read("junit.xml").c_str()));
  for (const auto& entry : fs::directory_iterator(folder_ / "allure")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_TRUE(nlohmann::json::accept(ReadFile(entry.path()))) << entry.path();
  }
}

TEST_F(ReportTest, TheSummaryFitsIntoAMail) {
  std::vector<RunResult> runs;
  for (int scene = 1; scene <= 30; ++scene) {
    runs.push_back(MakeRun(fmt::format("s{}", scene), "orbslam2", 1, 0.6));
  }
  WriteReport(Make(runs, {kBroken}), folder_);
  const std::string summary = Read("summary.txt");
  EXPECT_LE(std::count(summary.begin(), summary.end(), '\n'), 20);
  EXPECT_THAT(summary,
              testing::StartsWith("quickstart: 30 of 30 verdicts failed (limits on 1 score, in 30 "
                                  "cells), 0 of 30 runs"));
  EXPECT_THAT(summary, HasSubstr("and 24 more"));
  EXPECT_THAT(summary, HasSubstr("again:  ./aisle run"));
}

TEST_F(ReportTest, AllureKeepsATestsHistoryFromNightToNight) {
  Results results = Make({MakeRun("s", "orbslam2", 1, 0.6), Crashed("boom")}, {kBroken});
  const auto tests = [&] {
    WriteAllure(results, folder_, folder_ / "allure");
    std::map<std::string, nlohmann::json> by_name;
    for (const auto& entry : fs::directory_iterator(folder_ / "allure")) {
      if (entry.path().extension() != ".json") continue;
      const nlohmann::json test = nlohmann::json::parse(ReadFile(entry.path()));
      by_name[test.at("name")] = test;
    }
    return by_name;
  };
  const auto first = tests();
  ASSERT_EQ(first.size(), 3u);  // a limit, a crash, and a run that came to its end
  const nlohmann::json& limit = first.at("s live orbslam2: ate_rmse_m");
  EXPECT_EQ(limit.at("status"), "failed");
  EXPECT_THAT(limit.at("statusDetails").at("trace").get<std::string>(),
              HasSubstr("rerun: ./aisle rerun s/live/orbslam2/1 --in "));
  EXPECT_EQ(first.at("paper.scene2/live/mine/1: completes").at("status"), "broken");
  EXPECT_EQ(first.at("s/live/orbslam2/1: completes").at("status"), "passed");
  results.started = "2026-02-01T02:00:00Z";
  const auto second = tests();
  EXPECT_EQ(second.size(), first.size());  // those of the night before are gone
  for (const auto& [name, test] : first) {
    EXPECT_EQ(second.at(name).at("historyId"), test.at("historyId"));
    EXPECT_NE(second.at(name).at("uuid"), test.at("uuid"));
  }
}

TEST_F(ReportTest, ThePageObeysTheStrictestPolicy) {
  WriteReport(Make({MakeRun("paper/scene2", "oracle", 1, 0.02)}, {}), folder_);
  std::string page = Read("index.html");
  // The one script stands in a file of its own: where it is forbidden the page is whole without.
  const std::string script = "<script src=\"report.js\" defer></script>";
  ASSERT_THAT(page, HasSubstr(script));
  page.erase(page.find(script), script.size());
  for (const char* forbidden : {"<script", " style=\"", "data:", "http:", "https:", "onclick"}) {
    EXPECT_THAT(page, Not(HasSubstr(forbidden)));
  }
}

TEST_F(ReportTest, TwoHundredRunsFitIntoThreeMegabytesWithoutTheirPictures) {
  NightOptions options;
  options.scenes = 40;
  options.systems = {"orbslam2", "semantic", "paper", "robust", "oracle"};
  options.frames = 600;
  WriteReport(MakeNight(options, folder_), folder_);
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  EXPECT_LT(bytes, 3'000'000u);
}

TEST_F(ReportTest, HostileNamesDoNoHarmAnywhere) {
  const std::string hostile[] = {"\"><script>alert(1)</script>",
                                 "../../etc/x",
                                 "a\nb\x1b[31m",
                                 std::string(4096, 'n'),
                                 "\xff\xfe",
                                 "CON",
                                 "",
                                 "..",
                                 "&<'"};
  std::vector<RunResult> runs;
  for (const std::string& name : hostile) runs.push_back(MakeRun(name, "oracle", 1, 0.01));
  const Results results = Make(runs, {kTight});
  WriteReport(results, folder_);
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    const std::string path = fs::relative(entry.path(), folder_).string();
    EXPECT_EQ(path.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789_.-/"),
              std::string::npos)
        << path;
    if (entry.path().extension() != ".html") continue;
    EXPECT_THAT(ReadFile(entry.path()), Not(HasSubstr("<script>")));
  }
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(Read("junit.xml").c_str()));
  EXPECT_EQ(ReadResults(folder_).runs.size(), std::size(hostile));
}

TEST_F(ReportTest, CellsWithoutABaselineAreSaidInTheMorning) {
  Results results = Make({MakeRun("s", "oracle", 1, 0.01)}, {kTight});
  Verdict& without = results.verdicts.emplace_back();
  without.name = kWithoutBaseline;
  without.passed = true;
  without.why = "3 cells have no baseline";
  EXPECT_TRUE(ToConsole(results, {}).ends_with("verdicts passed\n3 cells have no baseline\n"));
  EXPECT_THAT(ToSummaryText(results, {}, folder_), HasSubstr("  3 cells have no baseline\n"));
}

/// What got worse over all cells of a system is read wherever verdicts are.
TEST_F(ReportTest, ASystemThatGotWorseEverywhereIsSaidInEveryWriting) {
  Results before, after;
  for (int scene = 0; scene < 20; ++scene) {
    RunRecord& run = before.runs.emplace_back();
    run.spec = {.scene = fmt::format("s{}", scene), .scene_file = "", .system = BuiltIn("oracle")};
    run.scores["ate_rmse_m"] = {
        .value = 0.01, .unit = "m", .alignment = "se3", .n = 1, .absent = ""};
    after.runs.push_back(run);
    *after.runs.back().scores["ate_rmse_m"].value = 0.015;
  }
  Results results = Make({MakeRun("s0", "oracle", 1, 0.01)}, {});
  results.verdicts = GateVerdicts(before, after);
  const std::string name = "all cells of oracle";
  const std::string why = "worse: by 50 % (median of 20 cells); 20 of 20 seeds got worse";
  WriteReport(results, folder_);
  for (const std::string& text : {ToConsole(results, {}), ToSummaryText(results, {}, folder_),
                                  Read("index.html"), Read("results.json"), Read("junit.xml")}) {
    EXPECT_THAT(text, HasSubstr(name));
    EXPECT_THAT(text, HasSubstr(why));
  }
  EXPECT_THAT(Read("junit.xml"), HasSubstr("failures=\"1\""));
  EXPECT_FALSE(AllPassed(results));
}

TEST_F(ReportTest, WhatFailedStandsNearestToThePrompt) {
  std::vector<RunResult> runs;
  for (int i = 0; i < 20; ++i) runs.push_back(MakeRun(fmt::format("s{}", i), "oracle", 1, 0.01));
  runs.push_back(MakeRun("weakness/optical_axis", "oracle", 1, 0.6));
  const Results results = Make(runs, {kBroken, kTight});
  const auto failed = std::count_if(results.verdicts.begin(), results.verdicts.end(),
                                    [](const Verdict& verdict) { return !verdict.passed; });
  ASSERT_GE(failed, 1);
  for (const std::size_t width : {0u, 80u, 140u}) {
    const std::string text = ToConsole(results, {.color = false, .width = width});
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (width > 0) {
      for (const std::string& line : lines) EXPECT_LE(ShownWidth(line), width) << line;
    }
    EXPECT_THAT(lines.back(), HasSubstr(fmt::format("{} failed", failed)));
    EXPECT_THAT(text, Not(HasSubstr("\npass")));
    const std::size_t first = text.find("\nFAIL  ");
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_GT(first, text.rfind("/oracle/1")) << "what failed is below the runs";
    const auto lines_of_failures = std::count_if(
        lines.begin(), lines.end(), [](const auto& line) { return line.starts_with("FAIL  "); });
    EXPECT_EQ(lines_of_failures, failed);
    const auto below =
        std::count(text.begin() + static_cast<std::ptrdiff_t>(first) + 1, text.end(), '\n');
    EXPECT_TRUE(width > 0 || below == failed + 1) << "in a log each is a line";
  }
}

TEST_F(ReportTest, JunitCarriesTheNumbers) {
  const Results results = Make({MakeRun("s", "orbslam2", 1, 0.6)}, {kBroken});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(ToJunit(results).c_str()));
  const pugi::xml_node suite = document.child("testsuites").child("testsuite");
  EXPECT_STREQ(suite.attribute("failures").value(), "1");
  const pugi::xml_node test = suite.child("testcase");
  EXPECT_STREQ(test.attribute("classname").value(), "quickstart.s live orbslam2");
  EXPECT_STREQ(test.attribute("name").value(), "ate_rmse_m");
  EXPECT_THAT(test.child("failure").attribute("message").value(), HasSubstr("is not at most 0.02"));
}

TEST_F(ReportTest, JunitNamesTheRunToRepeatAndQuotesItsLastWords) {
  const Results results = Make({MakeRun("s", "orbslam2", 1, 0.3), MakeRun("s", "orbslam2", 2, 0.6),
                                Crashed("map.cc:42: Assertion failed")},
                               {kBroken});
  const std::string junit = ToJunit(results, "out/tonight");
  EXPECT_THAT(junit, HasSubstr("rerun: ./aisle rerun s/live/orbslam2/2 --in out/tonight"));
  EXPECT_THAT(junit, HasSubstr("rerun: ./aisle rerun paper.scene2/live/mine/1 --in out/tonight"));
  EXPECT_THAT(junit, HasSubstr("its last words:\nmap.cc:42: Assertion failed"));
}

/// The code points of UTF-8 text, strictly: overlong forms, surrogates and stray bytes throw.
std::u32string CodePoints(const std::string& text) {
  std::u32string points;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text.at(at + i)); };
    const int more = byte(0) < 0x80 ? 0 : std::countl_one(byte(0)) - 1;
    if (more > 3 || (more == 0 && byte(0) >= 0x80)) throw std::runtime_error("a stray byte");
    char32_t point = more == 0 ? byte(0) : byte(0) & (0x3Fu >> more);
    for (int i = 1; i <= more; ++i) {
      if ((byte(static_cast<std::size_t>(i)) & 0xC0) != 0x80) throw std::runtime_error("too short");
      point = point << 6 | (byte(static_cast<std::size_t>(i)) & 0x3Fu);
    }
    constexpr char32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
    if (point < kLeast[more]) throw std::runtime_error("overlong");
    points += point;
    at += static_cast<std::size_t>(more) + 1;
  }
  return points;
}

/// Char of XML 1.0, section 2.2.
bool IsXmlCharacter(char32_t c) {
  return c == 0x9 || c == 0xA || c == 0xD || (c >= 0x20 && c <= 0xD7FF) ||
         (c >= 0xE000 && c <= 0xFFFD) || (c >= 0x10000 && c <= 0x10FFFF);
}

TEST_F(ReportTest, JunitIsWellFormedWhateverASystemSays) {
  const std::string said =
      "ä\xEF\xBF\xBE\xEF\xBF\xBF😀 \xEF\xBF\xBD\x01\x1b\xFF\xC0\xAF\xED\xA0\x80\xE2\x82 <&\"]]>";
  Results results = Make({Crashed("x")}, {});
  results.suite = said;
  results.runs.at(0).last_words = said;
  results.verdicts.at(0).name = said;
  results.verdicts.at(0).why = said;
  results.verdicts.at(0).scene = results.runs.at(0).spec.scene;
  results.verdicts.at(0).twin = results.runs.at(0).spec.twin;
  results.verdicts.at(0).system = results.runs.at(0).spec.system.name;
  const std::string junit = ToJunit(results);
  for (const char32_t c : CodePoints(junit)) {
    EXPECT_TRUE(IsXmlCharacter(c)) << static_cast<std::uint32_t>(c);
  }
  EXPECT_THAT(junit, HasSubstr("its last words:\nä😀 "));
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(junit.c_str()));
}

TEST_F(ReportTest, JunitNamesEveryRunThatCameToItsEnd) {
  const Results results = Make({MakeRun("s", "orbslam2", 1, 0.6)}, {});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(ToJunit(results).c_str()));
  const pugi::xml_node suite = document.child("testsuites").child("testsuite");
  EXPECT_STREQ(suite.attribute("tests").value(), "1");
  EXPECT_STREQ(suite.child("testcase").attribute("classname").value(),
               "quickstart.s/live/orbslam2/1");
  EXPECT_STREQ(suite.child("testcase").attribute("name").value(), "completes");
  EXPECT_FALSE(suite.child("testcase").child("failure"));
}

}  // namespace
}  // namespace aisle
