#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "harness/io/zip.h"
#include "harness/report/history.h"
#include "harness/report/tables.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Results Night(const std::string& started, double ate_m, const std::string& scene = "paper/one") {
  Results results;
  results.suite = "s";
  results.started = started;
  results.provenance.commit = "abc";
  for (const std::string system : {"orbslam2", "ora|cle_"}) {
    RunRecord run;
    run.spec = {.scene = scene, .scene_file = "", .twin = "live", .system = system, .seed = 1};
    for (const char* name : {"ate_rmse_m", "ate_mean_m", "ate_median_m", "ate_std_m"}) {
      run.scores[name] = {.value = ate_m, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
    }
    results.runs.push_back(run);
  }
  return results;
}

TEST(TablesTest, EveryWritingHasTheNumbersAndEscapesItsOwnMarks) {
  const Results results = Night("a", 0.01234);
  const auto tables = PaperTables(GroupByScene(results));
  ASSERT_EQ(tables.size(), 2u);  // drift and absolute error; what nobody measured is left out
  EXPECT_EQ(tables[1].groups.size(), 2u);
  EXPECT_EQ(tables[1].rows.at(0).cells.size(), 8u);
  EXPECT_THAT(ToHtml(tables), HasSubstr("<td>0.0123"));
  EXPECT_THAT(ToMarkdown(tables), HasSubstr("ora\\|cle_ RMSE"));
  EXPECT_THAT(ToLatex(tables), HasSubstr("\\multicolumn{4}{c}{ora|cle\\_}"));
  EXPECT_THAT(ToLatex(tables), HasSubstr("paper/one & 0.0123"));
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
  for (const TrendPoint& point : ReadHistory(file_, "s")) {
    if (point.system == "orbslam2" && point.score == "ate_rmse_m") ates.push_back(*point.median);
  }
  EXPECT_THAT(ates, testing::ElementsAre(0.01, 0.03));
  EXPECT_TRUE(ReadHistory(file_, "other").empty());
  EXPECT_TRUE(ReadHistory("/nowhere/at/all.sqlite", "s").empty());
}

TEST_F(HistoryTest, TrendsAreDrawnFromTwoNightsOn) {
  const std::string hostile = "\"><script>alert(1)</script>'); DROP TABLE medians; --";
  AppendToHistory(file_, Night("1", 0.01, hostile));
  EXPECT_EQ(TrendSection(ReadHistory(file_, "s")), "");
  AppendToHistory(file_, Night("2", 0.02, hostile));
  const std::string section = TrendSection(ReadHistory(file_, "s"));
  EXPECT_THAT(section, HasSubstr("2 nights"));
  EXPECT_THAT(section, HasSubstr("data-name=\"ora|cle_\""));
  EXPECT_THAT(section, testing::Not(HasSubstr("<script")));
}

TEST(ZipTest, IsWhatOtherProgramsRead) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_zip_{}", ::getpid());
  fs::create_directories(folder);
  std::ofstream(folder / "a.zip", std::ios::binary)
      << MakeZip({{"x.npy", MakeNpy({1.5, -2.25, 1e300})}, {"n.json", "{\"a\": 1}"}});
  // NumPy and Python's zipfile are the readers that evo itself uses.
  const std::string check = fmt::format(
      "/usr/bin/python3 -c \"import io,json,zipfile,numpy; z = zipfile.ZipFile('{}'); "
      "assert z.testzip() is None; assert json.loads(z.read('n.json')) == dict(a=1); "
      "a = numpy.load(io.BytesIO(z.read('x.npy'))); assert a.tolist() == [1.5, -2.25, 1e300]\"",
      (folder / "a.zip").string());
  EXPECT_EQ(std::system(check.c_str()), 0);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace aisle
