#include "harness/report/page/drive_outcome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/report/page/answer.h"
#include "harness/report/page/scene_tables.h"

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

TEST(DriveOutcome, AContactIsToldBeforeAnyDistance) {
  const auto drive_on = [](const std::string& scene, double docking_m) {
    RunRecord run = Drive("robust", docking_m);
    run.spec.scene = scene;
    return run;
  };
  RunRecord touched = drive_on("corner", 0.0002);
  touched.scores["collisions"].value = 1;
  RunRecord missed = drive_on("far", 0.03);
  missed.scores["goal_reached"].value = 0;
  const auto answer =
      AnswerInWords(Of({drive_on("dock", 0.009), drive_on("aisle", 0.001), missed, touched}));
  ASSERT_EQ(answer.size(), 4u);
  EXPECT_THAT(answer[0], HasSubstr("On corner, robust ends 0.2 mm from its goal (runs into"));
  EXPECT_THAT(answer[1], HasSubstr("On far, robust ends 3.0 cm from its goal (misses"));
  EXPECT_THAT(answer[2], HasSubstr("On dock,"));
}

TEST(DriveOutcome, CountsTheSeedsThatWentWrongAndTakesTheMedian) {
  const Results results = Of({Drive("robust", 0.002, 1), Drive("robust", 0.004, 2),
                              Crashed(Drive("robust", 3.0, 3), 0, 1)});
  const auto scenes = GroupByScene(results);
  const auto outcomes = OutcomesOf(scenes[0]);
  ASSERT_EQ(outcomes.size(), 1u);
  const DriveOutcome& outcome = outcomes[0].second;
  EXPECT_EQ(outcome.docking_m, 0.004);
  EXPECT_FALSE(outcome.is_clean());
  EXPECT_EQ(WrongsInWords(outcome), "misses its goal in 1 of 3 and runs into people in 1 of 3");
}

TEST(DriveOutcome, ARunIntoAVehicleIsOneOfNeitherKind) {
  RunRecord run = Drive("robust", 0.002);
  run.scores["collisions"].value = 1;
  const Results results = Of({run});
  const auto outcomes = OutcomesOf(GroupByScene(results)[0]);
  EXPECT_EQ(WrongsInWords(outcomes.at(0).second), "runs into vehicles");
}

TEST(DriveOverview, BoldIsTheLeastOfThoseThatDidNothingWrong) {
  const Results results =
      Of({Crashed(Drive("orbslam2", 0.0001), 0, 1), Drive("plain", 0.0011), Drive("robust", 0.02)});
  const std::string text = DriveOverview(GroupByScene(results), SceneLinks{});
  EXPECT_THAT(text, HasSubstr("<td class=\"best\" data-value=\"0.0011\">1.1 mm"));
  EXPECT_THAT(text, HasSubstr("<td class=\"\" data-value=\"0.02\">20.0 mm"));
  EXPECT_THAT(text, HasSubstr("0.1 mm<br><span class=\"fail\">misses its goal"));
}

/// What never got as far as its drive has no score: killed, or teaching failed.
RunRecord Undriven(const std::string& system, std::uint64_t seed = 1) {
  RunRecord run = Drive(system, 0, seed);
  run.scores.clear();
  run.status = RunStatus::kTimeout;
  return run;
}

TEST(DriveOverview, WhoeverDidNotDriveInEverySeedIsNeverTheBest) {
  std::vector<RunRecord> runs;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    runs.push_back(seed <= 6 ? Drive("robust", 0.001, seed) : Undriven("robust", seed));
    runs.push_back(Drive("plain", 0.002, seed));
    runs.push_back(Undriven("orbslam2", seed));
  }
  const Results results = Of(runs);
  const std::string text = DriveOverview(GroupByScene(results), SceneLinks{});
  EXPECT_THAT(text, HasSubstr("<td class=\"best\" data-value=\"0.002\">2.0 mm"));
  EXPECT_THAT(text, HasSubstr("<td class=\"\" data-value=\"0.001\">1.0 mm<br><span "
                              "class=\"fail\">never drives in 3 of 9"));
  EXPECT_THAT(text, HasSubstr("<td class=\"\"><span class=\"fail\">never drives</span>"));
  const std::string sentence = DriveSentence(GroupByScene(results)[0]);
  EXPECT_THAT(sentence, HasSubstr("robust ends 1.0 mm from its goal (never drives in 3 of 9)"));
  EXPECT_THAT(sentence, HasSubstr("orbslam2 never drives"));
}

TEST(DriveOverview, WhoCannotSteerIsNotBlamedForNotDriving) {
  RunRecord led = Undriven("plain");
  led.spec.system = {.name = "foreign", .external = ExternalSystem{.command = "x {output}"}};
  led.status = RunStatus::kOk;
  const Results results = Of({Drive("robust", 0.001), led});
  EXPECT_THAT(DriveOverview(GroupByScene(results), SceneLinks{}),
              testing::Not(HasSubstr("never drives")));
}

/// Five of nine goals: no median says so.
TEST(DriveTable, GoalsAndTouchesAreMeansOverTheDrives) {
  std::vector<RunRecord> runs;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    RunRecord run = Drive("robust", 0.001, seed);
    runs.push_back(seed <= 4 ? Crashed(run, 2, 1) : run);
  }
  const Results results = Of(runs);
  const std::string table = DriveTable(GroupByScene(results)[0].systems);
  EXPECT_THAT(table, HasSubstr("<th>touches<br>a drive"));
  EXPECT_THAT(table, HasSubstr("<td>56<td>1.0<"));
  EXPECT_THAT(table, HasSubstr("<td>1.3<"));
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
