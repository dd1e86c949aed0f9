#include "harness/score/drive_scores.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

/// Ten samples along x, each so far left of the route.
DriveLog StraightDrive(double left_m) {
  DriveLog log;
  log.route = {{{0, 0}, 0}, {{9, 0}, 0}};
  log.route_m = 9;
  log.planned_s = 10;
  log.goal = {{9, 0}, 0};
  log.goal_tolerance_m = 0.02;
  log.goal_tolerance_rad = 0.02;
  for (int k = 0; k < 10; ++k) {
    DriveSample sample;
    sample.stamp_ns = k * 1'000'000'000LL;
    sample.truth = {{static_cast<double>(k), left_m}, 0.01};
    sample.belief = {{static_cast<double>(k), 0}, 0};
    sample.cross_track_m = left_m;
    sample.heading_error_rad = 0.01;
    sample.route_m = k;
    log.track.samples.push_back(sample);
  }
  log.track.end = DriveEnd::kArrived;
  log.track.time_s = 12;
  log.track.frames_due = 100;
  log.track.frames_shown = 75;
  log.truth_steered = log.track;
  return log;
}

double ValueOf(const DriveLog& log, const char* score) {
  return ScoreDrive(log).at(score).value.value();
}

TEST(DriveScoresTest, AConstantOffsetIsEveryKindOfDistance) {
  const DriveLog log = StraightDrive(-0.015);
  EXPECT_NEAR(ValueOf(log, "cross_track_rms_m"), 0.015, 1e-12);
  EXPECT_NEAR(ValueOf(log, "cross_track_max_m"), 0.015, 1e-12);
  EXPECT_NEAR(ValueOf(log, "belief_error_rms_m"), 0.015, 1e-12);
  EXPECT_NEAR(ValueOf(log, "docking_error_m"), 0.015, 1e-12);
  EXPECT_NEAR(ValueOf(log, "docking_error_deg"), 0.01 * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(ValueOf(log, "goal_reached"), 1);
  EXPECT_EQ(ValueOf(log, "route_completion"), 1);
  EXPECT_NEAR(ValueOf(log, "time_over_planned"), 1.2, 1e-12);
  EXPECT_NEAR(ValueOf(log, "frames_dropped"), 0.25, 1e-12);
}

TEST(DriveScoresTest, TheGoalIsReachedWithinItsTolerancesOnly) {
  EXPECT_EQ(ValueOf(StraightDrive(0.021), "goal_reached"), 0);
  DriveLog turned = StraightDrive(0);
  turned.track.samples.back().truth.heading_rad = 0.03;
  EXPECT_EQ(ValueOf(turned, "goal_reached"), 0);
  DriveLog stuck = StraightDrive(0);
  stuck.track.end = DriveEnd::kNoProgress;
  EXPECT_EQ(ValueOf(stuck, "goal_reached"), 0);
}

TEST(DriveScoresTest, OneThatEndsHalfWayHasCompletedHalf) {
  DriveLog log = StraightDrive(0);
  log.track.samples.resize(5);
  log.track.end = DriveEnd::kContact;
  EXPECT_NEAR(ValueOf(log, "route_completion"), 4.0 / 9, 1e-12);
  EXPECT_NEAR(ValueOf(log, "docking_error_m"), 5, 1e-12);
}

TEST(DriveScoresTest, WhoRunsIntoAVehicleThatStandsIsNotItsCollision) {
  DriveLog log = StraightDrive(0);
  log.track.contacts = {{0, "rack", "rack", 0.4, {}, false},
                        {1, "anna", "person", 0.8, {}, true},
                        {2, "bert", "person", 0.0, {}, true},
                        {3, "truck", "forklift", 1.2, {}, true},
                        {4, "gate", "mechanism", 1.1, {}, true}};
  EXPECT_EQ(ValueOf(log, "collisions"), 4);
  EXPECT_EQ(ValueOf(log, "collisions_static"), 1);
  EXPECT_EQ(ValueOf(log, "collisions_person"), 1);
  EXPECT_EQ(ValueOf(log, "collisions_vehicle"), 2);
  EXPECT_EQ(ValueOf(log, "collision_speed_max_mps"), 1.2);
}

TEST(DriveScoresTest, UnderWayItHasTakenTheTimeUntilNow) {
  DriveLog log = StraightDrive(0);
  log.track.time_s = 0;  // as nothing has ended
  log.track.samples.resize(6);
  EXPECT_DOUBLE_EQ(ValueOf(log, "drive_time_s"), 5);
  EXPECT_DOUBLE_EQ(ValueOf(log, "time_over_planned"), 0.5);
}

TEST(DriveScoresTest, ADriveThatHasNotBegunHasNoErrors) {
  DriveLog log = StraightDrive(0);
  log.track = log.truth_steered = {};
  log.track.end = DriveEnd::kArrived;
  const Scorecard scores = ScoreDrive(log);
  EXPECT_EQ(ValueOf(log, "goal_reached"), 0);
  EXPECT_EQ(ValueOf(log, "route_completion"), 0);
  for (const auto& [name, score] : scores) {
    const bool is_of_track = name.find("error") != std::string::npos ||
                             name.find("cross_track") != std::string::npos ||
                             name.find("time") != std::string::npos;
    if (!is_of_track) continue;
    EXPECT_FALSE(score.value) << name;
    EXPECT_FALSE(score.absent.empty()) << name;
  }
  EXPECT_EQ(ScoreDrive(StraightDrive(0)).size(), scores.size());
}

TEST(DriveScoresTest, WhatWasNotThereHasNoClearance) {
  const Scorecard scores = ScoreDrive(StraightDrive(0));
  EXPECT_FALSE(scores.at("min_clearance_person_m").value);
  EXPECT_FALSE(scores.at("time_to_collision_min_s").value);
  EXPECT_FALSE(scores.at("min_clearance_person_m").absent.empty());
}

}  // namespace
}  // namespace aisle
