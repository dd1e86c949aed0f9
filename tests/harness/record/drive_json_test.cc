#include "harness/record/drive_json.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <chrono>
#include <limits>
#include <set>

#include "harness/contract/drive_names.h"
#include "harness/io/input_error.h"
#include "tests/support/arbitrary.h"

namespace aisle {
namespace {

Eigen::Vector2d AnyPoint() { return {AnyNumber(), AnyNumber()}; }
FloorPose AnyFloorPose() { return {AnyPoint(), AnyNumber()}; }
/// Infinite now and then, as the distance to nobody is.
double AnyDistance() { return AnyFlag() ? AnyNumber() : std::numeric_limits<double>::infinity(); }

DriveSample AnySample() {
  return {.stamp_ns = AnyWhole<std::int64_t>(),
          .truth = AnyFloorPose(),
          .belief = AnyFloorPose(),
          .speed_mps = AnyNumber(),
          .yaw_rate_rad_s = AnyNumber(),
          .cross_track_m = AnyNumber(),
          .heading_error_rad = AnyNumber(),
          .route_m = AnyNumber(),
          .estimate_age_s = AnyNumber(),
          .clearance_static_m = AnyDistance(),
          .clearance_actor_m = AnyDistance(),
          .mode = static_cast<DriveMode>(AnyOf(0, 6))};
}

ActorTrack AnyActor() {
  return {.name = AnyText(),
          .object_class = AnyText(),
          .radius_m = AnyNumber(),
          .from = AnyList(4, AnyPoint),
          .to = AnyList(4, AnyPoint)};
}

Contact AnyContact() {
  return {.stamp_ns = AnyWhole<std::int64_t>(),
          .with = AnyText(),
          .object_class = AnyText(),
          .speed_mps = AnyNumber(),
          .vehicle = AnyFloorPose(),
          .is_actor = AnyFlag()};
}

ZoneViolation AnyViolation() {
  return {.stamp_ns = AnyWhole<std::int64_t>(), .zone = AnyText(), .speed_mps = AnyNumber()};
}

FloorThing AnyThing() {
  return {.name = AnyText(), .object_class = AnyText(), .outline = AnyList(5, AnyPoint)};
}

DriveTrack AnyTrack() {
  return {.samples = AnyList(4, AnySample),
          .actors = AnyList(3, AnyActor),
          .contacts = AnyList(3, AnyContact),
          .violations = AnyList(3, AnyViolation),
          .end = static_cast<DriveEnd>(AnyOf(0, 5)),
          .time_s = AnyNumber(),
          .min_clearance_static_m = AnyDistance(),
          .min_clearance_person_m = AnyDistance(),
          .min_clearance_vehicle_m = AnyDistance(),
          .min_time_to_collision_s = AnyDistance(),
          .stops = AnyWhole<int>(),
          .scanner_stops = AnyWhole<int>(),
          .stopped_s = AnyNumber(),
          .lost_s = AnyNumber(),
          .frames_due = AnyWhole<int>(),
          .frames_shown = AnyWhole<int>()};
}

DriveLog AnyLog() {
  return {.route = AnyList(5, AnyFloorPose),
          .route_m = AnyNumber(),
          .planned_s = AnyNumber(),
          .goal = AnyFloorPose(),
          .goal_tolerance_m = AnyNumber(),
          .goal_tolerance_rad = AnyNumber(),
          .footprint = AnyList(5, AnyPoint),
          .things = AnyList(3, AnyThing),
          .latency_ms = AnyNumber(),
          .steered_by = AnyText(),
          .taught = AnyFlag(),
          .track = AnyTrack(),
          .truth_steered = AnyTrack(),
          .loop_ms = AnyNumber()};
}

bool Equal(const FloorThing& a, const FloorThing& b) {
  return a.name == b.name && a.object_class == b.object_class && a.outline == b.outline;
}

/// All but loop_ms, a time of the wall: the file is the same bits for the same drive.
TEST(DriveJson, KeepsADriveToTheLastBit) {
  EXPECT_TRUE(rc::check([] {
    const DriveLog log = AnyLog();
    const DriveLog read = DriveLogFromJson(ToJson(log), "drive.json");
    RC_ASSERT(read.route == log.route && read.goal == log.goal);
    RC_ASSERT(read.route_m == log.route_m && read.planned_s == log.planned_s);
    RC_ASSERT(read.goal_tolerance_m == log.goal_tolerance_m);
    RC_ASSERT(read.goal_tolerance_rad == log.goal_tolerance_rad);
    RC_ASSERT(read.footprint == log.footprint);
    RC_ASSERT(std::equal(read.things.begin(), read.things.end(), log.things.begin(),
                         log.things.end(),
                         [](const auto& a, const auto& b) { return Equal(a, b); }));
    RC_ASSERT(read.latency_ms == log.latency_ms && read.steered_by == log.steered_by);
    RC_ASSERT(read.taught == log.taught);
    RC_ASSERT(read.track == log.track);
    RC_ASSERT(read.truth_steered == log.truth_steered);
  }));
}

TEST(DriveJson, WhatIsNoDriveIsRefusedWithItsFile) {
  const std::string good = ToJson(DriveLog{});
  for (const std::string& text :
       {std::string("{}"), std::string("[1, 2]"), std::string(), good.substr(0, good.size() / 2)}) {
    try {
      DriveLogFromJson(text, "some/drive.json");
      ADD_FAILURE() << text.substr(0, 40);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("some/drive.json"), 0u) << error.what();
    }
  }
}

/// Each held against all before it, they would take a minute and more.
TEST(DriveJson, ManyKeysTakeLittleTime) {
  std::string text = "{";
  for (int i = 0; i < 200'000; ++i) text += fmt::format("\"column_{}\":1,", i);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(DriveLogFromJson(text + "\"schema\":0}", "drive.json"), InputError);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(DriveNames, EveryEndAndModeHasItsOwn) {
  std::set<std::string> ends, modes;
  for (int i = 0; i < 5; ++i) ends.insert(Name(static_cast<DriveEnd>(i)));
  for (int i = 0; i < 6; ++i) modes.insert(Name(static_cast<DriveMode>(i)));
  EXPECT_EQ(ends.size(), 5u);
  EXPECT_EQ(modes.size(), 6u);
}

}  // namespace
}  // namespace aisle
