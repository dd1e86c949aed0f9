#include "harness/record/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <set>

#include "harness/io/input_error.h"
#include "tests/harness/record/two_systems.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class HistoryTest : public testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::temp_directory_path() / fmt::format("aisle_history_{}.sqlite", ::getpid());
  }
  void TearDown() override {
    for (const char* ending : {"", "-journal", "-wal", "-shm"}) fs::remove(file_.string() + ending);
  }
  fs::path file_;
};

TEST_F(HistoryTest, NightsComeBackInOrderAndTheSameNightOnce) {
  AppendToHistory(file_, Night("2026-01-02T02:00:00Z", 0.02));
  AppendToHistory(file_, Night("2026-01-01T02:00:00Z", 0.01));
  AppendToHistory(file_, Night("2026-01-02T02:00:00Z", 0.03));
  std::vector<double> ates;
  for (const TrendPoint& point : ReadHistory(file_, "nightly")) {
    if (point.system == "orbslam2" && point.score == "ate_rmse_m") ates.push_back(*point.median);
  }
  EXPECT_THAT(ates, testing::ElementsAre(0.01, 0.03));
  EXPECT_TRUE(ReadHistory(file_, "other").empty());
  EXPECT_TRUE(ReadHistory("/nowhere/at/all.sqlite", "nightly").empty());
}

TEST_F(HistoryTest, IsOneFileThatSeveralHostsMayShare) {
  sqlite3* of_before = nullptr;  // those had SQLite's WAL, whose index is one host's memory
  ASSERT_EQ(sqlite3_open(file_.c_str(), &of_before), SQLITE_OK);
  sqlite3_exec(of_before, "PRAGMA journal_mode = WAL; CREATE TABLE x (y)", nullptr, nullptr,
               nullptr);
  sqlite3_close(of_before);
  AppendToHistory(file_, Night("2026-01-02T02:00:00Z", 0.02));
  // Bytes 18 and 19 of the header: 1 is the rollback journal, 2 the WAL.
  std::ifstream stream(file_, std::ios::binary);
  std::string header(20, ' ');
  stream.read(header.data(), 20);
  EXPECT_EQ(header.substr(18), "\1\1");
  EXPECT_FALSE(ReadHistory(file_, "nightly").empty());
}

TEST_F(HistoryTest, ANightTellsItsSpreadItsLimitItsFailuresAndWhereItLies) {
  Results night = Night("2026-01-01T02:00:00Z", 0.02);
  RunRecord crashed = night.runs.front();
  crashed.spec.seed = 2;
  crashed.status = RunStatus::kCrashed;
  crashed.scores.clear();
  night.runs.push_back(crashed);
  night.runs.front().system_version = "v1.4";
  night.verdicts.push_back({.name = "paper/one live orbslam2: ate_rmse_m",
                            .limit = 0.05,
                            .why = "",
                            .scene = "paper/one",
                            .twin = "live",
                            .system = "orbslam2"});
  AppendToHistory(file_, night, file_.parent_path() / "out" / "night one");
  bool found = false;
  for (const TrendPoint& point : ReadHistory(file_, "nightly")) {
    if (point.system != "orbslam2" || point.score != "ate_rmse_m") continue;
    found = true;
    EXPECT_EQ(point.median, 0.02);  // of those that came to an end
    EXPECT_EQ(point.low, 0.02);
    EXPECT_EQ(point.limit, 0.05);
    EXPECT_EQ(point.seeds, 2u);
    EXPECT_EQ(point.failed, 1u);
    EXPECT_EQ(point.version, "v1.4");
    EXPECT_EQ(point.folder, "out/night one");
  }
  EXPECT_TRUE(found);
}

/// As the gate counts them: a seed that ran four times is one seed, its value the median of them.
TEST_F(HistoryTest, RepeatsOfASeedAreNoSeeds) {
  Results night = Night("2026-01-01T02:00:00Z", 0.02);
  const auto add = [&](std::uint64_t seed, int repeat, double ate_m, RunStatus status) {
    RunRecord run = night.runs.front();
    run.spec.seed = seed;
    run.spec.repeat = repeat;
    run.status = status;
    run.scores.at("ate_rmse_m").value = ate_m;
    night.runs.push_back(run);
  };
  const RunRecord first = night.runs.front();
  for (int repeat = 2; repeat <= 4; ++repeat) {
    add(first.spec.seed, repeat, 0.02, repeat < 4 ? RunStatus::kCrashed : RunStatus::kOk);
  }
  add(first.spec.seed + 1, 1, 0.1, RunStatus::kOk);
  add(first.spec.seed + 2, 1, 0.3, RunStatus::kOk);
  AppendToHistory(file_, night);
  std::size_t found = 0;
  for (const TrendPoint& point : ReadHistory(file_, "nightly")) {
    if (point.system != first.spec.system.name || point.score != "ate_rmse_m") continue;
    ++found;
    EXPECT_EQ(point.median, 0.1);
    EXPECT_EQ(point.seeds, 3u);
    EXPECT_EQ(point.failed, 1u);
  }
  EXPECT_EQ(found, 1u);
}

TEST_F(HistoryTest, ANightOfTheSameStartFromAnotherFolderIsToldBeforeItIsReplaced) {
  const fs::path out = file_.parent_path() / "out";
  const Results night = Night("2026-01-02T02:00:00Z", 0.02);
  EXPECT_EQ(NightReplaced(file_, night, out / "a"), "") << "no file yet";
  AppendToHistory(file_, night, out / "a");
  EXPECT_EQ(NightReplaced(file_, night, out / "a"), "") << "the same evening filed twice";
  EXPECT_EQ(NightReplaced(file_, night, out / "a/"), "");
  EXPECT_THAT(NightReplaced(file_, night, out / "b"), testing::HasSubstr("replaces out/a in"));
  const Results moment_later = Night("2026-01-02T02:00:00.250Z", 0.03);
  EXPECT_EQ(NightReplaced(file_, moment_later, out / "b"), "");
  AppendToHistory(file_, moment_later, out / "b");
  std::set<std::string> folders;
  for (const TrendPoint& point : ReadHistory(file_, "nightly")) folders.insert(point.folder);
  EXPECT_THAT(folders, testing::ElementsAre("out/a", "out/b"));
}

TEST_F(HistoryTest, AFileOfAnEarlierVersionIsBroughtUpToDate) {
  sqlite3* old = nullptr;
  ASSERT_EQ(::sqlite3_open(file_.c_str(), &old), SQLITE_OK);
  ASSERT_EQ(::sqlite3_exec(old,
                           "CREATE TABLE medians (suite TEXT, started TEXT, commit_id TEXT, scene "
                           "TEXT, twin TEXT, system TEXT, score TEXT, median REAL, seeds INTEGER, "
                           "PRIMARY KEY (suite, started, scene, twin, system, score)) WITHOUT "
                           "ROWID; INSERT INTO medians VALUES ('nightly', '1', 'abc', 's', 'live', "
                           "'plain', 'ate_rmse_m', 0.5, 9)",
                           nullptr, nullptr, nullptr),
            SQLITE_OK);
  ::sqlite3_close(old);
  AppendToHistory(file_, Night("2", 0.02));
  const std::vector<TrendPoint> points = ReadHistory(file_, "nightly");
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(points.front().median, 0.5);
  EXPECT_EQ(points.front().seeds, 9u);
  EXPECT_EQ(points.front().failed, 0u);
  EXPECT_FALSE(points.front().low.has_value());
}

TEST_F(HistoryTest, WhatKeepsANightFromItIsKnownBefore) {
  EXPECT_EQ(HistoryTrouble(file_), "");
  EXPECT_FALSE(std::filesystem::exists(file_));
  AppendToHistory(file_, Night("1", 0.01));
  EXPECT_EQ(HistoryTrouble(file_), "");
  {
    std::ofstream damaged(file_, std::ios::in | std::ios::out);
    damaged << std::string(4096, 'x');
  }
  EXPECT_NE(HistoryTrouble(file_).find("not a database"), std::string::npos)
      << HistoryTrouble(file_);
  EXPECT_EQ(HistoryTrouble(file_ / "a/history.sqlite"), file_.string() + ": not a folder");
}

/// SQLite itself takes it for a new database, and the nights before would be gone without a word.
TEST_F(HistoryTest, AFileThatWasCutToNothingIsToldAndLeftAsItIs) {
  std::ofstream(file_).close();
  const auto says_what_to_do =
      testing::AllOf(testing::StartsWith(file_.string() + ": damaged: the file is empty"),
                     testing::HasSubstr("restore it"), testing::HasSubstr("delete it"));
  const auto why_not = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const MachineError& trouble) {
      return trouble.what();
    }
    return "";
  };
  EXPECT_THAT(HistoryTrouble(file_), says_what_to_do);
  EXPECT_THAT(why_not([&] { ReadHistory(file_, "nightly"); }), says_what_to_do);
  EXPECT_THAT(why_not([&] { AppendToHistory(file_, Night("1", 0.01)); }), says_what_to_do);
  EXPECT_EQ(NightReplaced(file_, Night("1", 0.01), file_.parent_path() / "out"), "");
  EXPECT_EQ(fs::file_size(file_), 0u);
  fs::remove(file_);
  AppendToHistory(file_, Night("1", 0.01));
  EXPECT_FALSE(ReadHistory(file_, "nightly").empty()) << "a new one";
}

TEST_F(HistoryTest, AFirstNightThatCannotBeWrittenLeavesNoEmptyFile) {
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit nothing = before;
  nothing.rlim_cur = 0;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // writing fails, as on a full disk
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &nothing), 0);
  EXPECT_THROW(AppendToHistory(file_, Night("1", 0.01)), MachineError);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_EQ(HistoryTrouble(file_), "");
}

TEST_F(HistoryTest, TheFirstNightLeavesNothingBesideItsFile) {
  AppendToHistory(file_, Night("1", 0.01));
  for (const auto& entry : fs::directory_iterator(file_.parent_path())) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(!name.starts_with(file_.filename().string()) || entry.path() == file_) << name;
  }
}

TEST_F(HistoryTest, NamesAreValuesAndNeverStatements) {
  const std::string hostile = "'); DROP TABLE medians; --";
  AppendToHistory(file_, Night("1", 0.01, hostile));
  AppendToHistory(file_, Night("2", 0.02));
  const std::vector<TrendPoint> points = ReadHistory(file_, "nightly");
  EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                          [&](const TrendPoint& point) { return point.scene == hostile; }));
  EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                          [](const TrendPoint& point) { return point.started == "2"; }));
}

}  // namespace
}  // namespace aisle
