// A heading has no beginning: what is known of a docking must not depend on where angles are cut.
#include <gtest/gtest.h>

#include "harness/score/drive_scores.h"

namespace aisle {
namespace {

DriveLog Docked(double goal_rad, double end_rad) {
  DriveLog log;
  log.route = {{{0, 0}, goal_rad}, {{9, 0}, goal_rad}};
  log.route_m = 9;
  log.planned_s = 10;
  log.goal = {{9, 0}, goal_rad};
  log.goal_tolerance_m = 0.02;
  log.goal_tolerance_rad = 0.02;
  DriveSample end;
  end.truth = end.belief = {{9, 0}, end_rad};
  end.route_m = 9;
  log.track.samples = {end};
  log.track.end = DriveEnd::kArrived;
  log.track.time_s = 10;
  return log;
}

constexpr double kPi = std::numbers::pi;

TEST(DockingAngleTest, IsTheShorterWayRound) {
  for (const auto& [goal, end] :
       {std::pair{kPi, -kPi + 0.01}, std::pair{-kPi, kPi - 0.01}, std::pair{3 * kPi, kPi + 0.01},
        std::pair{0.3, 0.29 + 2 * kPi}, std::pair{0.3, 0.31 - 6 * kPi}}) {
    const DriveLog log = Docked(goal, end);
    const Scorecard scores = ScoreDrive(log);
    EXPECT_NEAR(scores.at("docking_error_deg").value.value(), 0.01 * 180 / kPi, 1e-9)
        << goal << " " << end;
    EXPECT_EQ(scores.at("goal_reached").value, 1) << goal << " " << end;
    EXPECT_TRUE(ReachedGoal(log, log.track));
  }
  EXPECT_NEAR(ScoreDrive(Docked(kPi, 0)).at("docking_error_deg").value.value(), 180, 1e-9);
}

}  // namespace
}  // namespace aisle
