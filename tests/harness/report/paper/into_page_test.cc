#include "harness/report/paper/into_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

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

std::string Marked(const std::string& between) {
  return std::string("# Page\n\nBefore.\n") + kTablesBegin + "\n" + between + kTablesEnd +
         "\n\nAfter.\n";
}

TEST(IntoPage, ReplacesWhatStandsBetweenTheMarks) {
  const std::string page = WithTables(Marked("old\n"), "page.md", OneRun());
  EXPECT_TRUE(page.starts_with("# Page\n\nBefore.\n"));
  EXPECT_TRUE(page.ends_with(std::string(kTablesEnd) + "\n\nAfter.\n"));
  EXPECT_THAT(page, HasSubstr("1.2500"));
  EXPECT_THAT(page, HasSubstr("(abc)"));
  EXPECT_THAT(page, HasSubstr("    ./aisle run scenes/suites/paper.yaml --out out/paper\n"));
  EXPECT_THAT(page, Not(HasSubstr("old")));
  EXPECT_EQ(WithTables(page, "page.md", OneRun()), page);
}

TEST(IntoPage, RefusesAPageWithoutItsPlace) {
  const auto complaint = [](const std::string& page) -> std::string {
    try {
      WithTables(page, "page.md", OneRun());
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint("# Page\n"), HasSubstr("page.md: the line '<!-- tables begin"));
  EXPECT_THAT(complaint("# Page\n"), HasSubstr("is missing"));
  EXPECT_THAT(complaint(Marked("") + Marked("")), HasSubstr("is there twice"));
  EXPECT_THAT(complaint(std::string(kTablesEnd) + "\n" + kTablesBegin + "\n"),
              HasSubstr("must come before"));
}

}  // namespace
}  // namespace aisle
