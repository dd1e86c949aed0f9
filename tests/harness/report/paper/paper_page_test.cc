#include "harness/report/paper/paper_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/report/paper/tables.h"
#include "tests/harness/record/night.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class PaperPageTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_paper_{}", ::getpid());
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Runs of three seeds; every seed pushes the estimate twice as far as the one before.
  void Add(const std::string& scene, const std::string& system, int seeds = 3) {
    for (int seed = 1; seed <= seeds; ++seed) {
      const RunResult run =
          MakeRun(scene, system, static_cast<std::uint64_t>(seed), 0.1 * (1 << seed), 200);
      const RunScore score = ScoreRun(run);
      results_.runs.push_back(WriteRun(run, score, MakeRecord(run, score, 20), folder_));
    }
  }
  std::string PageText() const { return PaperPage(GroupByScene(results_), folder_); }

  Results results_;
  fs::path folder_;
};

TEST_F(PaperPageTest, ShowsTheFiguresWithWhatWasPrintedOfThem) {
  for (const char* system : {"orbslam2", "oracle"}) {
    for (const char* scene : {"paper/scene1", "paper/scene3", "paper/scene4"}) Add(scene, system);
  }
  const std::string page = PageText();
  EXPECT_THAT(page, HasSubstr("trajectory error over frames"));
  EXPECT_THAT(page, HasSubstr("0.18 m"));
  EXPECT_THAT(page, HasSubstr("corners rejected over frames"));
  EXPECT_THAT(page, HasSubstr("241 to 263"));
  EXPECT_THAT(page, HasSubstr("paper/scene3, seed 1: final tracks"));
  EXPECT_THAT(page, HasSubstr("paper/scene4, seed 1: final tracks"));
  EXPECT_THAT(page, Not(HasSubstr("paper/scene2, seed")));
  EXPECT_THAT(page, HasSubstr("as printed: paper/scene1"));
  for (const char* forbidden : {"<script", " style=\"", "http:"}) {
    EXPECT_THAT(page, Not(HasSubstr(forbidden)));
  }
}

TEST_F(PaperPageTest, IsForTheScenesOfThePaperAlone) {
  Add("weakness/creep", "oracle", 1);
  EXPECT_THAT(PageText(), IsEmpty());
}

TEST_F(PaperPageTest, WithoutTheFramesTheTablesStand) {
  Add("paper/scene2", "orbslam2");
  fs::remove_all(folder_);
  EXPECT_THAT(PageText(), HasSubstr("Absolute trajectory error"));
}

TEST_F(PaperPageTest, TablesGiveTheMedianAndBeneathItTheLeastAndTheMost) {
  Add("paper/scene2", "orbslam2");
  std::vector<double> ate;
  for (const RunRecord& run : results_.runs) ate.push_back(*run.scores.at("ate_rmse_m").value);
  const auto tables = PaperTables(GroupByScene(results_));
  const auto table = std::find_if(tables.begin(), tables.end(), [](const NumberTable& one) {
    return one.title.starts_with("Absolute trajectory error");
  });
  ASSERT_NE(table, tables.end());
  ASSERT_GE(table->rows.size(), 3u);
  EXPECT_EQ(table->rows[0].cells[0], fmt::format("{:.4f}", ate[1]));
  EXPECT_EQ(table->rows[0].intervals[0], fmt::format("({:.4f} to {:.4f})", ate[0], ate[2]));
  EXPECT_TRUE(table->rows[1].spread);
  EXPECT_EQ(table->rows[1].cells[0], fmt::format("{:.4f}–{:.4f}", ate[0], ate[2]));
  EXPECT_TRUE(table->rows[2].printed);
  EXPECT_EQ(table->rows[2].cells[0], "0.8670");
}

TEST_F(PaperPageTest, OneSeedHasNoSpread) {
  Add("paper/scene2", "orbslam2", 1);
  for (const NumberTable& table : PaperTables(GroupByScene(results_))) {
    for (const NumberTable::Row& row : table.rows) EXPECT_FALSE(row.spread) << table.title;
  }
}

}  // namespace
}  // namespace aisle
