#include "harness/report/paper/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/harness/record/two_systems.h"

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

NumberTable ErrorTable() {
  return {.title = "Error",
          .caption = "Of the track.",
          .groups = {"orbslam2", "robust"},
          .columns = {"RMSE", "max"},
          .unit = "m",
          .rows = {}};
}

NumberTable::Row NineSeeds() {
  return {.name = "paper/scene2",
          .scene = "paper/scene2",
          .cells = {"1.35", "1.83", "0.04", "-"},
          .seeds = 9,
          .intervals = {"[0.01, 1.65]", "[0.02, 2.17]", "[0.03, 0.05]", "-"}};
}

TEST(TablesTest, EveryWritingHasTheNumbersAndEscapesItsOwnMarks) {
  const Results results = Night("a", 0.01234);
  const auto tables = PaperTables(GroupByScene(results));
  ASSERT_EQ(tables.size(), 2u);  // drift and absolute error; what nobody measured is left out
  EXPECT_EQ(tables[1].groups.size(), 2u);
  EXPECT_EQ(tables[1].rows.at(0).cells.size(), 8u);
  EXPECT_THAT(ToHtml(tables), HasSubstr("<td>0.0123"));
  EXPECT_THAT(ToMarkdown(tables), HasSubstr("\n| paper/one | ora\\|cle_ | 0.0123 |"));
  EXPECT_THAT(ToLatex(tables), HasSubstr("\\multicolumn{4}{c}{ora|cle\\_}"));
  EXPECT_THAT(ToLatex(tables), HasSubstr("paper/one & 0.0123"));
}

TEST(TablesTest, WhatMoversCostIsATableWhereTwinsTellIt) {
  Results results = Night("a", 0.01234);
  for (RunRecord& run : results.runs) {
    run.scores["dynamic_penalty"].value = run.spec.system.name == "orbslam2" ? 1.25 : 1.0;
  }
  const auto tables = PaperTables(GroupByScene(results));
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[2].title, "What movers cost");
  EXPECT_THAT(ToMarkdown(tables),
              HasSubstr("| orbslam2 | 1.25 |\n| paper/one | ora\\|cle_ | 1.00 |\n"));
}

TEST(TablesTest, WhatShareOfTheDriveAnErrorIsOfStandsUnderIt) {
  Results results = Night("a", 0.01234);
  for (RunRecord& run : results.runs) run.scores["coverage"].value = 0.5;
  const auto tables = PaperTables(GroupByScene(results));
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[2].title, "Frames with a pose [%]");
  EXPECT_THAT(ToMarkdown(tables), HasSubstr("| scene | system | coverage \\[%] |\n|---|---|---:|\n"
                                            "| paper/one | orbslam2 | 50.0 |\n"));
}

TEST(TablesTest, MarkdownHasARowForEachSceneAndSystemAndUnderItWhatWasPrinted) {
  NumberTable table = ErrorTable();
  table.rows = {NineSeeds(),
                {.name = "9 seeds, least [95 % of the median] most: paper/scene2",
                 .scene = "paper/scene2",
                 .cells = {"0.00 [0.01–1.65] 2.13", "0.01 [0.02–2.17] 2.70", "0.03 [..] 0.07", "-"},
                 .spread = true,
                 .seeds = 9,
                 .intervals = {}},
                {.name = "as printed: paper/scene2",
                 .scene = "paper/scene2",
                 .cells = {"0.87", "-", "", ""},
                 .printed = true,
                 .intervals = {}},
                {.name = "as printed: KITTI 01",
                 .scene = "KITTI 01",
                 .cells = {"10.40", "-", "", ""},
                 .printed = true,
                 .intervals = {}}};
  EXPECT_EQ(
      ToMarkdown({table}),
      "## Error\n\nOf the track.\n\n"
      "Cells: of 9 seeds the median and, in brackets, its 95 % interval (bootstrap); the HTML "
      "report has the least and the most too.\n\n"
      "| scene | system | RMSE \\[m] | max \\[m] |\n"
      "|---|---|---:|---:|\n"
      "| paper/scene2 | orbslam2 | 1.35 [0.01, 1.65] | 1.83 [0.02, 2.17] |\n"
      "| paper/scene2 | orbslam2, as printed | 0.87 | - |\n"
      "| paper/scene2 | robust | 0.04 [0.03, 0.05] | - |\n"
      "| KITTI 01 | orbslam2, as printed | 10.40 | - |\n\n");
  // The page and the paper keep a row a scene, with the spread beneath it.
  EXPECT_THAT(ToHtml({table}), HasSubstr("<td>0.00 [0.01–1.65] 2.13"));
  EXPECT_THAT(ToHtml({table}), Not(HasSubstr("[0.01, 1.65]")));
  EXPECT_THAT(ToLatex({table}), HasSubstr("paper/scene2 & 1.35 & 1.83 & 0.04 & -"));
}

TEST(TablesTest, MarkdownSaysWhatStandsBehindAMedian) {
  NumberTable table = ErrorTable();
  NumberTable::Row row = NineSeeds();
  row.seeds = 3;
  row.intervals = {"(0.01 to 1.65)", "(0.02 to 2.17)", "(0.03 to 0.05)", "-"};
  table.rows = {row};
  EXPECT_THAT(
      ToMarkdown({table}),
      HasSubstr("Cells: of 3 seeds the median and, in parentheses, the least and the most."));
  table.rows.push_back(NineSeeds());
  EXPECT_THAT(ToMarkdown({table}),
              HasSubstr("Cells: of 3 to 9 seeds the median and, in brackets, "
                        "its 95 % interval (bootstrap), or of fewer than five, "
                        "in parentheses, the least and the most; "));
  row.seeds = 1;
  row.intervals.clear();
  table.rows = {row};
  EXPECT_THAT(ToMarkdown({table}), Not(HasSubstr("Cells:")));
}

TEST(TablesTest, NoMarkdownTableIsWiderThanItsMeasures) {
  Results results = Night("a", 0.01234);
  for (RunRecord& run : results.runs) {
    for (const char* score :
         {"objects_moving", "objects_found", "objects_missed", "objects_invented", "object_iou",
          "t_rel_short_percent", "rpe_trans_rmse_m", "ms_tracking_mean", "coverage"}) {
      run.scores[score].value = 1;
    }
  }
  std::istringstream lines(ToMarkdown(PaperTables(GroupByScene(results))));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| scene")) continue;
    EXPECT_LE(std::ranges::count(line, '|'), 7) << line;
  }
}

}  // namespace
}  // namespace aisle
