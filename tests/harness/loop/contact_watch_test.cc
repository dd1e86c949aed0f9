#include "harness/loop/contact_watch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/harness/loop/fake_drive_scene.h"

namespace aisle {
namespace {

constexpr double kStep_s = 0.01;
constexpr std::int64_t kStep_ns = 10'000'000;

/// What is seen of a vehicle that speeds up from standing, by so much a step, with all in place.
DriveTrack SpeedUp(const FakeDriveScene& scene, double by_mps, double by_rad_s, int steps = 20) {
  DriveTrack track;
  ContactWatch watch(scene.course(), &track);
  Encounter now;
  for (std::size_t i = 0; i < scene.course().actors.size(); ++i) {
    now.actors.push_back(scene.ActorAt(i, 0));
  }
  watch.See(now, 0, 0);
  for (int k = 1; k <= steps; ++k) {
    now.stamp_ns += kStep_ns;
    now.speed_mps += by_mps;
    now.turn_rate_rad_s += by_rad_s;
    const double way = now.speed_mps * kStep_s, turn = now.turn_rate_rad_s * kStep_s;
    now.vehicle = AlongArc(now.vehicle, way, turn);
    watch.See(now, way, turn);
  }
  return track;
}

int DrivenInto(const DriveTrack& track) {
  return static_cast<int>(std::ranges::count_if(
      track.contacts, [](const Contact& contact) { return contact.speed_mps > kUnderWay_mps; }));
}

FakeDriveScene Leaning(const Eigen::Vector2d& at) {
  FakeDriveScene scene;
  scene.Add({"walker", "person"}, at, {0, 0});
  return scene;
}

TEST(WhoLeansOnTheVehicleTest, IsDrivenIntoOnlyByMotionTowardsHim) {
  struct {
    const char* where;
    Eigen::Vector2d at;
    double by_mps, by_rad_s;
    bool driven_into;
  } const cases[] = {
      {"behind, it drives off", {-0.5, 0}, 0.006, 0, false},
      {"behind, it backs up", {-0.5, 0}, -0.006, 0, true},
      {"ahead, it drives on", {0.9, 0}, 0.006, 0, true},
      {"ahead, it backs off", {0.9, 0}, -0.006, 0, false},
      {"beside, it drives by", {0.2, 0.5}, 0.006, 0, false},
      {"left of its nose, which turns left", {0.6, 0.5}, 0, 0.02, true},
      {"left of its nose, which turns right", {0.6, 0.5}, 0, -0.02, false},
  };
  for (const auto& [where, at, by_mps, by_rad_s, driven_into] : cases) {
    const DriveTrack track = SpeedUp(Leaning(at), by_mps, by_rad_s);
    EXPECT_EQ(DrivenInto(track), driven_into ? 1 : 0) << where;
    EXPECT_EQ(track.contacts.size(), driven_into ? 2u : 1u) << where;
    EXPECT_EQ(track.min_time_to_collision_s == 0, driven_into) << where;
  }
}

/// How fast a post was touched beside the left flank's front by a vehicle in a steady bend.
double SpeedOfTouch(double speed_mps, double turn_rate_rad_s) {
  FakeDriveScene scene;
  scene.edit().things.push_back({"post", "column", {{0.3, 0.5}, {0.4, 0.5}, {0.4, 0.6}}});
  DriveTrack track;
  ContactWatch watch(scene.course(), &track);
  Encounter now;
  now.speed_mps = speed_mps;
  now.turn_rate_rad_s = turn_rate_rad_s;
  watch.See(now, 0, 0);
  for (int k = 0; k < 300 && track.contacts.empty(); ++k) {
    const double way = speed_mps * kStep_s, turn = turn_rate_rad_s * kStep_s;
    now.stamp_ns += kStep_ns;
    now.vehicle = AlongArc(now.vehicle, way, turn);
    watch.See(now, way, turn);
  }
  return track.contacts.empty() ? -1 : track.contacts.front().speed_mps;
}

TEST(SpeedOfATouchTest, HasTheTurnInItAtAnySpeedOfTheAxle) {
  const double reach = std::hypot(0.7, 0.3);
  EXPECT_NEAR(SpeedOfTouch(0, 1), reach, 1e-12);
  double before = reach;
  for (double speed = 0.001; speed < 0.2; speed += 0.001) {
    const double now = SpeedOfTouch(speed, 1);
    // A corner is faster or slower by what the axle is at most, and there is no jump.
    EXPECT_LE(std::abs(now - before), 0.001 + 1e-12) << speed;
    before = now;
  }
}

/// Turns on the spot by 0.4 rad in one step: the front's left corner comes by between its ends.
DriveTrack SweepBy(const FakeDriveScene& scene) {
  DriveTrack track;
  ContactWatch watch(scene.course(), &track);
  Encounter now;
  now.turn_rate_rad_s = 4;
  for (std::size_t i = 0; i < scene.course().actors.size(); ++i) {
    now.actors.push_back(scene.ActorAt(i, 0));
  }
  watch.See(now, 0, 0);
  now.stamp_ns += 100'000'000;
  now.vehicle.heading_rad = 0.4;
  watch.See(now, 0, 0.4);
  return track;
}

TEST(SweptContactTest, HasNoClearanceBesideIt) {
  const double reach = std::hypot(0.7, 0.3), angle = std::atan2(0.3, 0.7) + 0.2;
  const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
  FakeDriveScene things;
  const Eigen::Vector2d tip = (reach - 0.005) * out, far = (reach + 0.2) * out;
  things.edit().things.push_back({"post", "column", {tip, far, far + Eigen::Vector2d(0.001, 0)}});
  const DriveTrack by_post = SweepBy(things);
  ASSERT_EQ(by_post.contacts.size(), 1u);
  EXPECT_EQ(by_post.min_clearance_static_m, 0);

  const DriveTrack by_person = SweepBy(Leaning((reach + 0.245) * out));
  ASSERT_EQ(by_person.contacts.size(), 1u);
  EXPECT_EQ(by_person.min_clearance_person_m, 0);
  EXPECT_EQ(by_person.min_time_to_collision_s, 0);
}

}  // namespace
}  // namespace aisle
