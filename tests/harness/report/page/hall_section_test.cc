#include "harness/report/page/hall_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

RunRecord MadeRun(const std::string& scene, const std::string& hall, const std::string& system,
                  std::uint64_t seed, double ate_m) {
  RunRecord run;
  run.spec = {.scene = scene, .scene_file = "", .system = BuiltIn(system), .seed = seed};
  run.hall = hall;
  run.scores["ate_rmse_m"].value = ate_m;
  return run;
}

TEST(HallSection, HasTheMedianOfEachSystemsRunsInAHall) {
  Results results;
  results.runs = {
      MadeRun("a", "cold_store", "plain", 1, 0.01), MadeRun("a", "cold_store", "plain", 2, 0.03),
      MadeRun("b", "cold_store", "plain", 1, 0.09), MadeRun("c", "workshop", "plain", 1, 0.05),
      MadeRun("c", "workshop", "oracle", 1, 0.02),  MadeRun("d", "", "plain", 1, 0.07)};
  const std::string text = HallSection(GroupByScene(results));
  EXPECT_THAT(text, HasSubstr("<tr><td>cold_store<td>3.00 <span class=\"soft\">of 3</span>"));
  EXPECT_THAT(text, HasSubstr("<tr><td>workshop<td>5.00 <span class=\"soft\">of 1</span><td>2.00"));
  EXPECT_THAT(text, HasSubstr("<tr><td>the scene's own<td>7.00"));
}

TEST(HallSection, IsNotThereWhereAllRanInOneHall) {
  Results results;
  results.runs = {MadeRun("a", "main", "plain", 1, 0.01), MadeRun("b", "main", "plain", 1, 0.03)};
  EXPECT_EQ(HallSection(GroupByScene(results)), "");
}

}  // namespace
}  // namespace aisle
