#include "harness/report/page/cost_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

Results Drives(const std::vector<std::pair<std::string, double>>& ate_m_of_twin) {
  Results results;
  for (const auto& [twin, ate_m] : ate_m_of_twin) {
    RunRecord run;
    run.spec = {
        .scene = "s", .scene_file = "", .twin = twin, .system = BuiltIn("robust"), .seed = 1};
    run.scores["ate_rmse_m"].value = ate_m;
    results.runs.push_back(run);
  }
  return results;
}

TEST(CostSectionTest, ShowsThePenaltyWhereThereIsATwin) {
  const Results both = Drives({{"live", 0.10}, {"empty", 0.02}});
  EXPECT_THAT(CostSection(GroupByScene(both)), testing::HasSubstr("×5.00"));
  const Results alone = Drives({{"live", 0.10}});
  EXPECT_EQ(CostSection(GroupByScene(alone)), "");
}

}  // namespace
}  // namespace aisle
