#include "harness/record/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace aisle {
namespace {

namespace fs = std::filesystem;

Results Night(const std::string& started, double ate_m, const std::string& scene = "paper/one") {
  Results results;
  results.suite = "nightly";
  results.started = started;
  results.provenance.commit = "abc";
  for (const std::string system : {"orbslam2", "ora|cle_"}) {
    RunRecord run;
    run.spec = {
        .scene = scene, .scene_file = "", .twin = "live", .system = BuiltIn(system), .seed = 1};
    run.scores["ate_rmse_m"] = {
        .value = ate_m, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
    results.runs.push_back(run);
  }
  return results;
}

class HistoryTest : public testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::temp_directory_path() / fmt::format("aisle_history_{}.sqlite", ::getpid());
  }
  void TearDown() override {
    for (const char* ending : {"", "-wal", "-shm"}) fs::remove(file_.string() + ending);
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
  EXPECT_EQ(HistoryTrouble(file_ / "a/history.sqlite"), file_.string() + ": is no folder");
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
