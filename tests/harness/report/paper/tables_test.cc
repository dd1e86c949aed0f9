#include "harness/report/paper/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;

Results Night(const std::string& started, double ate_m, const std::string& scene = "paper/one") {
  Results results;
  results.suite = "nightly";
  results.started = started;
  results.provenance.commit = "abc";
  for (const std::string system : {"orbslam2", "ora|cle_"}) {
    RunRecord run;
    run.spec = {
        .scene = scene, .scene_file = "", .twin = "live", .system = BuiltIn(system), .seed = 1};
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

}  // namespace
}  // namespace aisle
