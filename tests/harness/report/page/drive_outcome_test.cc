#include "harness/report/page/drive_outcome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/report/page/answer.h"

namespace aisle {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

RunRecord Drive(const std::string& system, double docking_m, std::uint64_t seed = 1) {
  RunRecord run;
  run.spec = {"d", "d.yaml", "live", BuiltIn(system), seed};
  run.scores["ate_rmse_m"].value = 0.001;
  run.scores["docking_error_m"].value = docking_m;
  run.scores["goal_reached"].value = 1;
  for (const char* score : {"collisions", "collisions_static", "collisions_person"}) {
    run.scores[score].value = 0;
  }
  return run;
}

RunRecord Crashed(RunRecord run, double things, double people) {
  run.scores["goal_reached"].value = 0;
  run.scores["collisions"].value = things + people;
  run.scores["collisions_static"].value = things;
  run.scores["collisions_person"].value = people;
  return run;
}

Results Of(std::vector<RunRecord> runs) {
  Results results;
  results.runs = std::move(runs);
  return results;
}

TEST(DriveOutcome, TheAnswerIsWhereTheVehiclesEndedNotTheirTrajectorysError) {
  EXPECT_THAT(
      AnswerInWords(Of({Crashed(Drive("orbslam2", 8.8), 1, 2), Drive("robust", 0.0008)})),
      ElementsAre("On d, orbslam2 ends 8.80 m from its goal (misses its goal, touches what stands "
                  "and runs into people) and robust ends 0.8 mm from its goal."));
}

TEST(DriveOutcome, CountsTheSeedsThatWentWrongAndTakesTheMedian) {
  const Results results = Of({Drive("robust", 0.002, 1), Drive("robust", 0.004, 2),
                              Crashed(Drive("robust", 3.0, 3), 0, 1)});
  const auto scenes = GroupByScene(results);
  const auto outcome = OutcomeOf(scenes[0].systems[0].runs);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->docking_m, 0.004);
  EXPECT_FALSE(outcome->is_clean());
  EXPECT_EQ(WrongsInWords(*outcome), "misses its goal in 1 of 3 and runs into people in 1 of 3");
}

TEST(DriveOutcome, ARunIntoAVehicleIsOneOfNeitherKind) {
  RunRecord run = Drive("robust", 0.002);
  run.scores["collisions"].value = 1;
  const Results results = Of({run});
  const auto outcome = OutcomeOf(GroupByScene(results)[0].systems[0].runs);
  EXPECT_EQ(WrongsInWords(*outcome), "runs into vehicles");
}

TEST(DriveOverview, BoldIsTheLeastOfThoseThatDidNothingWrong) {
  const Results results =
      Of({Crashed(Drive("orbslam2", 0.0001), 0, 1), Drive("plain", 0.0011), Drive("robust", 0.02)});
  const std::string text = DriveOverview(GroupByScene(results), SceneLinks{});
  EXPECT_THAT(text, HasSubstr("<td class=\"best\">1.1 mm"));
  EXPECT_THAT(text, HasSubstr("<td class=\"\">20.0 mm"));
  EXPECT_THAT(text, HasSubstr("0.1 mm<br><span class=\"fail\">misses its goal"));
}

TEST(DriveOverview, IsNotThereWhereNobodySteers) {
  RunRecord led;
  led.spec = {"s", "s.yaml", "live", BuiltIn("plain"), 1};
  led.scores["ate_rmse_m"].value = 0.5;
  const Results results = Of({led});
  EXPECT_EQ(DriveOverview(GroupByScene(results), SceneLinks{}), "");
  EXPECT_THAT(AnswerInWords(results), ElementsAre(HasSubstr("plain is off by 50 cm")));
}

}  // namespace
}  // namespace aisle
