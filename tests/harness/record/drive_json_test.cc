#include "harness/record/drive_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double In(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  std::size_t Below(std::size_t count) { return engine_() % count; }
  FloorPose Pose() { return {{In(-20, 20), In(-20, 20)}, In(-3, 3)}; }
  /// Infinite now and then, as the distance to nobody is.
  double Distance() { return Below(3) == 0 ? kInfinity : In(0, 9); }

 private:
  std::mt19937 engine_;
};

DriveTrack Track(Random* random, std::size_t samples) {
  DriveTrack track;
  for (std::size_t i = 0; i < samples; ++i) {
    DriveSample sample;
    sample.stamp_ns = 50'000'000LL * static_cast<std::int64_t>(i);
    sample.truth = random->Pose();
    sample.belief = random->Pose();
    sample.speed_mps = random->In(-1, 1);
    sample.yaw_rate_rad_s = random->In(-1, 1);
    sample.cross_track_m = random->In(-0.3, 0.3);
    sample.heading_error_rad = random->In(-0.3, 0.3);
    sample.route_m = random->In(0, 30);
    sample.estimate_age_s = random->In(0, 0.5);
    sample.clearance_static_m = random->Distance();
    sample.clearance_actor_m = random->Distance();
    sample.mode = static_cast<DriveMode>(random->Below(6));
    track.samples.push_back(sample);
  }
  for (std::size_t a = 0; a < random->Below(3); ++a) {
    ActorTrack actor{fmt::format("actor \"{}\"\n", a), "person", random->In(0.2, 1), {}, {}};
    for (std::size_t i = 0; i < samples; ++i) {
      actor.from.push_back(random->Pose().position);
      actor.to.push_back(a == 0 ? actor.from.back() : random->Pose().position);
    }
    track.actors.push_back(actor);
  }
  if (samples > 0) {
    track.contacts.push_back({track.samples.back().stamp_ns, "rack_0", "rack", random->In(-1, 1),
                              random->Pose(), random->Below(2) == 0});
    track.violations.push_back({track.samples.back().stamp_ns, "slow zone", random->In(0, 2)});
  }
  track.end = static_cast<DriveEnd>(random->Below(5));
  track.time_s = random->In(1, 90);
  track.min_clearance_static_m = random->Distance();
  track.min_clearance_person_m = random->Distance();
  track.min_clearance_vehicle_m = random->Distance();
  track.min_time_to_collision_s = random->Distance();
  track.stops = static_cast<int>(random->Below(4));
  track.scanner_stops = static_cast<int>(random->Below(4));
  track.stopped_s = random->In(0, 5);
  track.lost_s = random->In(0, 5);
  track.frames_due = 100;
  track.frames_shown = 97;
  return track;
}

DriveLog Log(unsigned seed) {
  Random random(seed);
  DriveLog log;
  for (std::size_t i = 0; i < 3 + random.Below(20); ++i) log.route.push_back(random.Pose());
  log.route_m = random.In(5, 50);
  log.planned_s = random.In(5, 50);
  log.goal = random.Pose();
  log.goal_tolerance_m = 0.05;
  log.goal_tolerance_rad = 0.1;
  log.footprint = {{-0.5, -0.4}, {0.9, -0.4}, {0.9, 0.4}, {-0.5, 0.4}};
  log.things = {{"rack_0", "rack", {{0, 0}, {3, 0}, {3, 1}}}};
  log.latency_ms = random.In(0, 200);
  log.steered_by = random.Below(2) ? "estimate" : "truth";
  log.track = Track(&random, random.Below(40));
  log.truth_steered = Track(&random, random.Below(10));
  log.loop_ms = random.In(0, 50);
  return log;
}

TEST(DriveJson, WhatIsWrittenIsReadAndWrittenAsTheSame) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const std::string text = ToJson(Log(seed));
    EXPECT_EQ(ToJson(DriveLogFromJson(text, "drive.json")), text) << seed;
  }
}

/// The file keeps some figures fewer than a double has: a tenth of a millimetre, of a milliradian
/// and of a millisecond must be left.
TEST(DriveJson, KeepsEveryQuantityToATenthOfAMillimetre) {
  const auto near = [](double a, double b) {
    return a == b || std::abs(a - b) <= 1e-4 * std::max(1.0, std::abs(a));
  };
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const DriveLog log = Log(seed), read = DriveLogFromJson(ToJson(log), "x");
    ASSERT_EQ(read.route.size(), log.route.size());
    EXPECT_TRUE(near(read.route_m, log.route_m));
    EXPECT_EQ(read.steered_by, log.steered_by);
    EXPECT_EQ(read.footprint, log.footprint);
    const DriveTrack &a = read.track, &b = log.track;
    ASSERT_EQ(a.samples.size(), b.samples.size());
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
      const DriveSample &p = a.samples[i], &q = b.samples[i];
      EXPECT_EQ(p.stamp_ns, q.stamp_ns);
      EXPECT_EQ(p.mode, q.mode);
      EXPECT_LT((p.truth.position - q.truth.position).norm(), 1e-4);
      EXPECT_LT((p.belief.position - q.belief.position).norm(), 1e-4);
      EXPECT_TRUE(near(p.truth.heading_rad, q.truth.heading_rad));
      EXPECT_TRUE(near(p.speed_mps, q.speed_mps));
      EXPECT_TRUE(near(p.cross_track_m, q.cross_track_m));
      EXPECT_TRUE(near(p.clearance_static_m, q.clearance_static_m)) << "infinite ones too";
      EXPECT_TRUE(near(p.clearance_actor_m, q.clearance_actor_m));
    }
    ASSERT_EQ(a.contacts.size(), b.contacts.size());
    for (std::size_t i = 0; i < a.contacts.size(); ++i) {
      EXPECT_EQ(a.contacts[i].with, b.contacts[i].with);
      EXPECT_EQ(a.contacts[i].is_actor, b.contacts[i].is_actor);
    }
    ASSERT_EQ(a.actors.size(), b.actors.size());
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.stops, b.stops);
    EXPECT_EQ(a.frames_shown, b.frames_shown);
    EXPECT_TRUE(near(a.min_time_to_collision_s, b.min_time_to_collision_s));
    EXPECT_TRUE(near(a.min_clearance_person_m, b.min_clearance_person_m));
  }
}

TEST(DriveJson, WhatIsNoDriveIsRefusedWithItsFile) {
  const std::string good = ToJson(Log(1));
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

TEST(DriveNames, EveryEndAndModeHasItsOwn) {
  std::set<std::string> ends, modes;
  for (int i = 0; i < 5; ++i) ends.insert(Name(static_cast<DriveEnd>(i)));
  for (int i = 0; i < 6; ++i) modes.insert(Name(static_cast<DriveMode>(i)));
  EXPECT_EQ(ends.size(), 5u);
  EXPECT_EQ(modes.size(), 6u);
}

}  // namespace
}  // namespace aisle
