#include "harness/report/page/overview_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

RunRecord MadeRun(const std::string& system, double ate_m, std::optional<double> coverage,
                  RunStatus status = RunStatus::kOk) {
  RunRecord run;
  run.spec = {.scene = "s", .scene_file = "", .twin = "live", .system = BuiltIn(system)};
  run.status = status;
  run.scores["ate_rmse_m"].value = ate_m;
  run.scores["coverage"].value = coverage;
  return run;
}

std::string Overview(std::vector<RunRecord> runs) {
  Results results;
  results.runs = std::move(runs);
  return OverviewSection(GroupByScene(results), SceneLinks{});
}

TEST(OverviewSection, TheLeastErrorIsBold) {
  const std::string text = Overview({MadeRun("plain", 0.5, 1.0), MadeRun("robust", 0.02, 0.995),
                                     MadeRun("oracle", 0.03, std::nullopt)});
  EXPECT_THAT(text, HasSubstr("<td class=\"best\">2.00 (99.5 %)"));
  EXPECT_THAT(text, Not(HasSubstr("best\">3.00")));
}

TEST(OverviewSection, ATrackWithTheHardPartMissingIsNotTheBest) {
  const std::string text = Overview({MadeRun("paper", 0.007, 0.6), MadeRun("robust", 0.02, 1.0),
                                     MadeRun("semantic", 0.01, 1.0, RunStatus::kLost)});
  EXPECT_THAT(text, HasSubstr("<td class=\"\">0.70 (60.0 %)"));
  EXPECT_THAT(text, HasSubstr("<td class=\"best\">2.00"));
}

TEST(OverviewSection, WhereNobodyDroveItWholeNobodyIsBest) {
  EXPECT_THAT(Overview({MadeRun("paper", 0.007, 0.6)}), Not(HasSubstr("class=\"best\"")));
}

}  // namespace
}  // namespace aisle
