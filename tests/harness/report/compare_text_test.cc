#include "harness/report/compare_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace aisle {
namespace {

using testing::HasSubstr;

TEST(CompareTextTest, EveryWritingNamesTheChange) {
  Comparison worse;
  worse.score = "ate_rmse_m";
  worse.old_median = 0.02;
  worse.new_median = 0.04;
  worse.old_n = worse.new_n = 9;
  worse.change = Change::kWorse;
  EXPECT_THAT(ToConsole({worse}, {}, {}), HasSubstr("1 worse"));
  EXPECT_THAT(ToMarkdown({worse}, {}), HasSubstr("| ate_rmse_m | worse |"));
  EXPECT_THAT(ToJson({worse}, {}), HasSubstr("\"change\": \"worse\""));
}

TEST(CompareTextTest, AScoreThatIsGoneIsNothingNow) {
  Comparison gone;
  gone.score = "ate_rmse_m";
  gone.old_median = 0.02;
  gone.new_median = std::nan("");
  gone.old_n = 9;
  gone.change = Change::kGone;
  for (const std::string& text : {ToConsole({gone}, {}, {}), ToMarkdown({gone}, {})}) {
    EXPECT_THAT(text, HasSubstr("nothing"));
    EXPECT_THAT(text, testing::Not(HasSubstr("nan")));
  }
}

TEST(CompareTextTest, ASystemOverAllItsCellsHasAFactorAndNoValues) {
  Comparison worse;
  worse.system = "plain";
  worse.score = "ate_rmse_m";
  worse.cells = 5;
  worse.old_n = worse.new_n = 45;
  worse.old_median = worse.new_median = 0.25;
  worse.factor = 1.3;
  worse.change = Change::kWorse;
  worse.why = "by 30 %";
  EXPECT_THAT(ToConsole({worse}, {}, {}), HasSubstr("all cells of plain"));
  EXPECT_THAT(ToConsole({worse}, {}, {}), testing::Not(HasSubstr("0.25")));
  EXPECT_THAT(ToMarkdown({worse}, {}),
              HasSubstr("| all cells of plain | ate_rmse_m | worse |  |  | +30.0 % | by 30 % |"));
  EXPECT_THAT(ToJson({worse}, {}), HasSubstr("\"cells\": 5"));
  EXPECT_THAT(ToJson({worse}, {}), HasSubstr("\"factor\": 1.3"));
}

TEST(CompareTextTest, ATerminalIsFilledAndALogHasALineForEach) {
  Comparison worse;
  worse.scene = "weakness/optical_axis";
  worse.twin = "live";
  worse.system = "paper_plain";
  worse.score = "rpe_1s_trans_rmse_m";
  worse.old_median = 0.02;
  worse.new_median = 0.04;
  worse.old_n = worse.new_n = 9;
  worse.change = Change::kWorse;
  worse.why = "differences of 9 pairs from 0.0123 to 0.0456, p 0.0001 of all that is compared";
  for (const std::size_t width : {80u, 100u, 140u}) {
    std::istringstream lines(ToConsole({worse}, {}, {.color = false, .width = width}));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), width) << line;
  }
  const std::string log = ToConsole({worse}, {}, {});
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 3) << log;
}

TEST(CompareTextTest, NamesStayInTheirCellOfTheMarkdown) {
  Comparison worse;
  worse.scene = worse.system = "a|b";
  worse.score = "ate_rmse_m";
  worse.why = "seed 1: said <x>|\ny";
  const std::string text =
      ToMarkdown({worse}, {{.scene = "a|b", .twin = "live", .system = "m|n", .seeds = {}}});
  EXPECT_THAT(text, HasSubstr("| a\\|b  a\\|b | ate_rmse_m |"));
  EXPECT_THAT(text, HasSubstr("said \\<x>\\| y |"));
  EXPECT_THAT(text, HasSubstr("| a\\|b live m\\|n |"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
}

TEST(CompareTextTest, EveryWritingNamesWhatIsMissing) {
  const std::vector<MissingRuns> missing = {
      {.scene = "a", .twin = "live", .system = "mine", .seeds = {1, 2}, .is_whole = true},
      {.scene = "b", .twin = "live", .system = "mine", .seeds = {3}}};
  const std::string console = ToConsole({}, missing, {});
  EXPECT_THAT(console, HasSubstr("the old side has it, the new one has not"));
  EXPECT_THAT(console, HasSubstr("the old side has seeds 3, the new one has not"));
  EXPECT_THAT(console, HasSubstr("0 cannot tell; 1 cell and 1 seed of 1 other are missing\n"));
  EXPECT_THAT(ToMarkdown({}, missing), HasSubstr("| a live mine | | missing |"));
  EXPECT_THAT(ToJson({}, missing), HasSubstr("\"whole\": true"));
}

}  // namespace
}  // namespace aisle
