// Bounds of what is counted against a drive, on both sides of each.
#include <gtest/gtest.h>

#include "harness/loop/closed_drive.h"
#include "harness/loop/contact_watch.h"
#include "tests/harness/loop/fake_drive_scene.h"

namespace aisle {
namespace {

constexpr double kStep_s = 0.01;
constexpr std::int64_t kStep_ns = 10'000'000;

/// What is seen of a vehicle that goes straight on at one speed.
DriveTrack GoStraight(const FakeDriveScene& scene, double speed_mps, int steps) {
  DriveTrack track;
  ContactWatch watch(scene.course(), &track);
  for (int k = 0; k <= steps; ++k) {
    Encounter now;
    now.stamp_ns = k * kStep_ns;
    now.speed_mps = speed_mps;
    now.vehicle.position.x() = k * kStep_s * speed_mps;
    for (std::size_t i = 0; i < scene.course().actors.size(); ++i) {
      now.actors.push_back(scene.ActorAt(i, now.stamp_ns));
    }
    watch.See(now, k == 0 ? 0 : kStep_s * speed_mps, 0);
  }
  return track;
}

/// Footprint and walker are 2 m apart: the nose is 0.7 m ahead, he has a radius of 0.25 m.
FakeDriveScene WalkerAhead(double his_speed_mps) {
  FakeDriveScene scene;
  scene.Add({"walker", "person"}, {2.95, 0}, {his_speed_mps, 0});
  return scene;
}

/// At a speed that stays, all instants foretell the same touch.
TEST(TimeToCollisionTest, IsTheGapOverTheSpeedOfClosing) {
  for (const auto& [speed, his] :
       {std::pair{0.5, 0.0}, std::pair{0.5, -0.3}, std::pair{1.0, 0.6}, std::pair{0.1, -1.0}}) {
    for (const int steps : {1, 50, 100}) {
      const DriveTrack track = GoStraight(WalkerAhead(his), speed, steps);
      EXPECT_NEAR(track.min_time_to_collision_s, 2 / (speed - his) - steps * kStep_s, 1e-9)
          << speed << " " << his << " " << steps;
    }
  }
}

TEST(TimeToCollisionTest, ThereIsNoneWithWhoKeepsAwayAndItIsOverWithTheTouch) {
  EXPECT_FALSE(std::isfinite(GoStraight(WalkerAhead(0.5), 0.5, 100).min_time_to_collision_s));
  EXPECT_FALSE(std::isfinite(GoStraight(WalkerAhead(0.9), 0.5, 100).min_time_to_collision_s));
  EXPECT_EQ(GoStraight(WalkerAhead(0), 0.5, 405).min_time_to_collision_s, 0);
}

/// Clearance from people is a person's, from a vehicle a vehicle's.
TEST(ClearanceTest, IsOfWhoItWas) {
  for (const bool is_person : {true, false}) {
    FakeDriveScene scene;
    scene.Add({"other", is_person ? "person" : "forklift"}, {1, 1}, {0, 0});
    const DriveTrack track = GoStraight(scene, 0.5, 300);
    const double gap = 1 - 0.3 - 0.25;
    EXPECT_NEAR(is_person ? track.min_clearance_person_m : track.min_clearance_vehicle_m, gap,
                1e-9);
    EXPECT_FALSE(
        std::isfinite(is_person ? track.min_clearance_vehicle_m : track.min_clearance_person_m));
  }
}

/// Who drives at a zone's speed wavers about it: 2 cm/s over it break nothing.
TEST(ZoneSpeedTest, IsBrokenFromTwoCentimetresASecondOverItOn) {
  FakeDriveScene scene;
  scene.edit().zones = {{"slow", {-9, -1}, {9, 1}, 0.3}};
  for (const double speed : {0.1, 0.3, 0.319, -0.3, -0.319}) {
    EXPECT_TRUE(GoStraight(scene, speed, 10).violations.empty()) << speed;
  }
  for (const double speed : {0.321, 0.4, -0.321}) {
    const DriveTrack track = GoStraight(scene, speed, 10);
    ASSERT_EQ(track.violations.size(), 1u) << speed;
    EXPECT_EQ(track.violations[0].speed_mps, speed);
  }
}

TEST(ZoneSpeedTest, OneToKeepOutOfIsBrokenAtAnySpeed) {
  FakeDriveScene scene;
  scene.edit().zones = {{"out", {1, -1}, {2, 1}, 0}};
  EXPECT_TRUE(GoStraight(scene, 0.01, 100).violations.empty()) << "its nose is at 0.71 m";
  EXPECT_EQ(GoStraight(scene, 0.01, 3100).violations.size(), 1u);
}

/// How far a vehicle turns on the spot, to the left (1) or right (-1), before it stands for its
/// scanner, which sees somebody where the nose would come by at full rate.
double TurnsUntilHeld(double reaction_s, double side) {
  FakeDriveScene scene;
  scene.edit().way = {{.kind = WayLeg::Kind::kPause, .duration_s = 0.5},
                      {.kind = WayLeg::Kind::kTurn, .duration_s = 5, .turn_to_rad = 3 * side},
                      scene.course().way[1]};
  scene.Add({"beside", "person"}, {0.8 * std::cos(2), side * 0.8 * std::sin(2)}, {0, 0});
  LoopOptions options;
  options.steering.scanner = true;
  options.scanner.reaction_s = reaction_s;
  options.scanner.clear_s = 1e9;  // it does not creep on
  options.no_progress_after_s = 3;
  TruthLocaliser truth;
  const DriveTrack track = DriveClosed(scene, &truth, options);
  EXPECT_EQ(track.scanner_stops, 1);
  EXPECT_EQ(track.end, DriveEnd::kNoProgress);
  EXPECT_TRUE(track.contacts.empty());
  EXPECT_NEAR(track.samples.back().yaw_rate_rad_s, 0, 1e-9);
  return side * track.samples.back().truth.heading_rad;
}

/// Who reacts later needs the turn of that time more before him.
TEST(TurningFieldTest, ReachesAsMuchFartherAsTheVehicleTurnsBeforeItReacts) {
  const double rate = DriverOptions{}.turn_rate_rad_s;
  for (const double side : {1.0, -1.0}) {
    const double at_once = TurnsUntilHeld(0, side);
    for (const double reaction_s : {0.3, 0.6}) {
      // A tick's turn may pass before the field is seen to be blocked.
      EXPECT_NEAR(at_once - TurnsUntilHeld(reaction_s, side), reaction_s * rate,
                  1.5 * rate * kStep_s)
          << side << " " << reaction_s;
    }
  }
}

}  // namespace
}  // namespace aisle
