#include "harness/report/paper/into_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

using testing::HasSubstr;

Results OneRun() {
  Results results;
  results.suite = "paper";
  results.rerun = "./aisle run scenes/suites/paper.yaml --out out/paper";
  results.provenance.commit = "abc";
  RunRecord run;
  run.spec = {.scene = "paper/scene2",
              .scene_file = "",
              .twin = "live",
              .system = BuiltIn("orbslam2"),
              .seed = 1};
  run.scores["ate_rmse_m"] = {.value = 1.25, .unit = "m", .alignment = "se3", .n = 9, .absent = ""};
  results.runs = {run};
  return results;
}

TEST(IntoPage, WritesTheTablesWithWhatTheyAreOf) {
  const std::string page = WithTables("Before.\n<!-- begin tables: slam -->\n<!-- end tables -->\n",
                                      {.file = "page.md", .block = "tables"}, OneRun());
  EXPECT_TRUE(
      page.starts_with("Before.\n<!-- begin tables: slam -->\n\nSuite paper, 1 runs, 1 seed."));
  EXPECT_THAT(page, HasSubstr("\n| scene | system | RMSE \\[m] |"));
  EXPECT_THAT(page, HasSubstr("| paper/scene2 | orbslam2 | 1.2500 | - | - | - |\n"
                              "| paper/scene2 | orbslam2, as printed | 0.8670 | 0.8500 |"));
  EXPECT_THAT(page, testing::Not(HasSubstr("\n\n\n")));
  EXPECT_THAT(page,
              HasSubstr("`./aisle run scenes/suites/paper.yaml --out out/paper`; commit abc, "));
}

TEST(IntoPage, WritesTheTablesThatWereAskedFor) {
  const std::string empty = "<!-- begin tables: slam -->\n<!-- end tables -->\n";
  const BlockPlace place{.file = "page.md", .block = "tables"};
  const std::string all = WithTables(empty, place, OneRun());
  const std::string one = WithTables(empty, place, OneRun(), "Absolute trajectory error");
  EXPECT_THAT(all, HasSubstr("## Drift and absolute error"));
  EXPECT_THAT(one, testing::Not(HasSubstr("## Drift and absolute error")));
  EXPECT_THAT(one, HasSubstr("## Absolute trajectory error [m]"));
  try {
    WithTables(empty, place, OneRun(), "no such");
    ADD_FAILURE() << "there is one";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no table's title holds 'no such'; there are: "));
  }
}

}  // namespace
}  // namespace aisle
