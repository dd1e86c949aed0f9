#include "harness/report/paper/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/record/two_systems.h"

namespace aisle {
namespace {

using testing::HasSubstr;

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

TEST(TablesTest, WhatMoversCostIsATableWhereTwinsTellIt) {
  Results results = Night("a", 0.01234);
  for (RunRecord& run : results.runs) {
    run.scores["dynamic_penalty"].value = run.spec.system.name == "orbslam2" ? 1.25 : 1.0;
  }
  const auto tables = PaperTables(GroupByScene(results));
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[2].title, "What movers cost");
  EXPECT_THAT(ToMarkdown(tables), HasSubstr("| 1.25 | 1.00 |"));
}

TEST(TablesTest, WhatShareOfTheDriveAnErrorIsOfStandsUnderIt) {
  Results results = Night("a", 0.01234);
  for (RunRecord& run : results.runs) run.scores["coverage"].value = 0.5;
  const auto tables = PaperTables(GroupByScene(results));
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[2].title, "Frames with a pose [%]");
  EXPECT_THAT(ToMarkdown(tables), HasSubstr("| 50.0 | 50.0 |"));
}

}  // namespace
}  // namespace aisle
