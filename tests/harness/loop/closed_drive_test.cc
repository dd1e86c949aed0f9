#include "harness/loop/closed_drive.h"

#include <gtest/gtest.h>

#include "harness/loop/contact_watch.h"
#include "harness/loop/server.h"
#include "harness/vehicle/taught_way.h"
#include "tests/harness/loop/fake_drive_scene.h"

namespace aisle {
namespace {

LoopOptions At(double latency_ms) {
  LoopOptions options;
  options.steering.latency_ms = latency_ms;
  return options;
}

DriveTrack DriveTruth(const DriveScene& scene, const LoopOptions& options = {}) {
  TruthLocaliser truth;
  return DriveClosed(scene, &truth, options);
}

TEST(ClosedDriveTest, KnowingTheTruthItStopsAtItsGoal) {
  const FakeDriveScene scene;
  for (const double latency_ms : {0.0, 50.0, 100.0, 200.0}) {
    const DriveTrack track = DriveTruth(scene, At(latency_ms));
    EXPECT_EQ(track.end, DriveEnd::kArrived);
    EXPECT_NEAR(track.samples.back().truth.position.x(), 8, 4e-3) << latency_ms;
    EXPECT_LT(std::abs(track.samples.back().cross_track_m), 4e-3) << latency_ms;
    EXPECT_LT(track.time_s, 1.6 * scene.course().planned_s);
    EXPECT_EQ(track.stops, 0);
    EXPECT_EQ(track.lost_s, 0);
  }
}

TEST(ClosedDriveTest, TheSystemsOwnWorldIsJoinedToTheSite) {
  DriftingLocaliser elsewhere;
  const DriveTrack track = DriveClosed(FakeDriveScene(), &elsewhere, {});
  EXPECT_EQ(track.end, DriveEnd::kArrived);
  EXPECT_NEAR(track.samples.back().truth.position.x(), 8, 4e-3);
}

/// Gives its map up at a time and begins another, where it then is.
class ForgettingLocaliser : public DriftingLocaliser {
 public:
  explicit ForgettingLocaliser(bool says_so) : says_so_(says_so) {}
  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    if (exposure.stamp_ns < 3'000'000'000) return DriftingLocaliser::Locate(exposure);
    if (!T_begun_) T_begun_ = exposure.T_world_rig;
    return T_begun_->inverse() * exposure.T_world_rig;
  }
  int map_id() const override { return says_so_ && T_begun_ ? 1 : 0; }

 private:
  const bool says_so_;
  std::optional<Eigen::Isometry3d> T_begun_;
};

TEST(ClosedDriveTest, AWorldThatIsBegunAnewIsJoinedToTheSiteByTheWheels) {
  ForgettingLocaliser says_so(true), keeps_silent(false);
  const FakeDriveScene scene;
  const DriveTrack track = DriveClosed(scene, &says_so, {});
  EXPECT_EQ(track.end, DriveEnd::kArrived);
  EXPECT_NEAR(track.samples.back().truth.position.x(), 8, 0.1) << "as exact as wheels are";
  EXPECT_EQ(track.lost_s, 0);
  EXPECT_NE(DriveClosed(scene, &keeps_silent, {}).end, DriveEnd::kArrived);
}

TEST(ClosedDriveTest, WhoBelievesADriftDrivesIt) {
  DriftingLocaliser drifting(0.02);
  const DriveTrack track = DriveClosed(FakeDriveScene(), &drifting, {});
  const DriveSample& end = track.samples.back();
  // 16 cm off to the left as it believes, so as many to the right in truth.
  EXPECT_NEAR(end.truth.position.y(), -0.16, 0.02);
  EXPECT_NEAR(end.cross_track_m, end.truth.position.y(), 1e-9);
  EXPECT_NEAR(end.belief.position.y(), 0, 0.01);
}

TEST(ClosedDriveTest, WhoWasTaughtByTheSameDriftArrives) {
  const FakeDriveScene scene;
  const Course& course = scene.course();
  DriftingLocaliser drifting(0.02);
  // What it says along the way, at the places of the way themselves.
  LoopOptions options;
  options.taught.emplace();
  std::vector<TaughtPose> poses;
  for (const WayPoint& point : course.way[1].points) {
    const FloorPose led{point.position, point.heading_rad};
    const Exposure exposure{.T_world_rig = scene.RigAt(led, 0)};
    const Eigen::Isometry3d said = *drifting.Locate(exposure);
    if (poses.empty()) options.taught->T_site_slam = exposure.T_world_rig * said.inverse();
    poses.push_back(
        {led, FromAbove(options.taught->T_site_slam * said * course.T_vehicle_rig.inverse())});
  }
  options.taught->way = TaughtWay(course.way, poses);
  const DriveSample end = DriveClosed(scene, &drifting, options).samples.back();
  EXPECT_NEAR(end.truth.position.x(), 8, 4e-3);
  // Not to the millimetre: by this map one looks ahead while one goes 1.1 degrees aside.
  EXPECT_NEAR(end.truth.position.y(), 0, 8e-3);
  EXPECT_NEAR(end.belief.position.y(), 0.16, 0.01) << "which it believes to be 16 cm aside";
}

TEST(ClosedDriveTest, ATaughtMapSaysWhereTheVehicleStands) {
  // The map's world is 5 cm to the left of the site's: put at its start, it drives to where the
  // map has its way.
  const FakeDriveScene scene;
  LoopOptions options;
  options.taught = {scene.course().way, Eigen::Isometry3d::Identity()};
  options.taught->T_site_slam.translation().y() = 0.05;
  TruthLocaliser truth;
  EXPECT_NEAR(DriveClosed(scene, &truth, options).samples.back().truth.position.y(), -0.05, 4e-3);
}

TEST(ClosedDriveTest, TheSameDriveHasTheSameBits) {
  const FakeDriveScene scene;
  DriftingLocaliser one(0.01), other(0.01);
  EXPECT_EQ(DriveClosed(scene, &one, At(70)), DriveClosed(scene, &other, At(70)));
  LoopOptions seeded = At(70);
  seeded.seed = 2;
  DriftingLocaliser third(0.01);
  EXPECT_NE(DriveClosed(scene, &third, seeded).samples.back().truth,
            DriveClosed(scene, &one, At(70)).samples.back().truth);
}

TEST(ClosedDriveTest, WhoIsDoneAsAFrameArrivesTakesThatFrame) {
  DriftingLocaliser localiser;
  DriveClosed(FakeDriveScene(), &localiser, At(100));
  ASSERT_GT(localiser.seen.size(), 50u);
  for (std::size_t i = 0; i < localiser.seen.size(); ++i) {
    ASSERT_EQ(localiser.seen[i], 2 * static_cast<std::int64_t>(i)) << "every other, none later";
  }
}

/// By hand: the answer to 0 is due at 91 ms, 1 came at 50 and has waited; that to 1 at 182, of 2
/// and 3 the newer has waited; that to 3 at 273, 5 has.
TEST(ClosedDriveTest, BetweenTwoTicksToo) {
  DriftingLocaliser localiser;
  DriveClosed(FakeDriveScene(), &localiser, At(91));
  ASSERT_GT(localiser.seen.size(), 6u);
  localiser.seen.resize(6);
  EXPECT_EQ(localiser.seen, (std::vector<std::int64_t>{0, 1, 3, 5, 7, 9}));
}

/// Believes twice the way that it goes.
class StretchingLocaliser : public Localiser {
 public:
  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    Eigen::Isometry3d T = exposure.T_world_rig;
    T.translation() *= 2;
    return T;
  }
};

TEST(ClosedDriveTest, WhatIsOnlyBelievedToBeDrivenIsNotDriven) {
  FakeDriveScene scene(7);
  WayLeg last = FakeDriveScene(1).course().way[1];
  for (WayPoint& point : last.points) point.position.x() += 7;
  scene.edit().way.push_back({.kind = WayLeg::Kind::kPause, .duration_s = 0.5});
  scene.edit().way.push_back(last);
  StretchingLocaliser localiser;
  const DriveTrack track = DriveClosed(scene, &localiser, {});
  const DriveSample& end = track.samples.back();
  ASSERT_LT(end.truth.position.x(), 4.5);
  EXPECT_NEAR(end.route_m, end.truth.position.x(), 0.6) << "not 7 m and more";
}

TEST(ClosedDriveTest, WhoNeverHasAPoseGivesUpAndWasLost) {
  DriftingLocaliser lost;
  lost.lost_to_ns = std::numeric_limits<std::int64_t>::max();
  const DriveTrack track = DriveClosed(FakeDriveScene(), &lost, {});
  EXPECT_EQ(track.end, DriveEnd::kNoProgress);
  EXPECT_NEAR(track.lost_s, track.time_s, 0.1);
}

TEST(ClosedDriveTest, LostInAPauseForGoodItGivesUp) {
  FakeDriveScene scene;
  scene.edit().way.front().duration_s = 8;
  DriftingLocaliser localiser;
  localiser.lost_from_ns = 2'000'000'000;
  localiser.lost_to_ns = std::numeric_limits<std::int64_t>::max();
  const DriveTrack track = DriveClosed(scene, &localiser, {});
  EXPECT_EQ(track.end, DriveEnd::kNoProgress);
  EXPECT_GT(track.lost_s, 20);
}

/// A rate at which the watch's patience is shorter than the time between two frames.
class SlowCamera : public FakeDriveScene {
 public:
  double rate_hz() const override { return 2; }
  std::int64_t Stamp(std::int64_t frame) const override { return frame * 500'000'000; }
};

TEST(ClosedDriveTest, ASlowCameraIsNoLostSystem) {
  DriftingLocaliser localiser;
  const DriveTrack track = DriveClosed(SlowCamera(), &localiser, {});
  EXPECT_EQ(track.end, DriveEnd::kArrived);
  EXPECT_EQ(track.lost_s, 0);
}

TEST(ClosedDriveTest, AScannerWatchesTurnsOnTheSpotToo) {
  FakeDriveScene scene;
  scene.edit().way = {{.kind = WayLeg::Kind::kPause, .duration_s = 0.5},
                      {.kind = WayLeg::Kind::kTurn, .duration_s = 3, .turn_to_rad = 1.5},
                      scene.course().way[1]};
  scene.Add({"beside", "person"}, {0.45, 0.7}, {0, 0});
  LoopOptions options;
  const DriveTrack blind = DriveTruth(scene, options);
  ASSERT_EQ(blind.contacts.size(), 1u);
  EXPECT_GT(blind.contacts[0].speed_mps, 0.1) << "its nose is under way, if its axle is not";
  options.steering.scanner = true;
  const DriveTrack track = DriveTruth(scene, options);
  EXPECT_TRUE(track.contacts.empty());
  EXPECT_GE(track.scanner_stops, 1);
}

/// A long tricycle needs more of a turn to stop than its own limit of turning would say.
TEST(ClosedDriveTest, AScannerKnowsHowATricycleStopsTurning) {
  FakeDriveScene scene;
  scene.edit().plant.kind = VehicleKind::kTricycle;
  scene.edit().plant.wheelbase_m = 2;
  scene.edit().plant.max_steering_rad = std::numbers::pi / 2;
  scene.edit().way = {{.kind = WayLeg::Kind::kPause, .duration_s = 0.5},
                      {.kind = WayLeg::Kind::kTurn, .duration_s = 4, .turn_to_rad = 2.5},
                      scene.course().way[1]};
  scene.Add({"behind", "person"}, {-0.55, 0.75}, {0, 0});
  LoopOptions options;
  const DriveTrack blind = DriveTruth(scene, options);
  ASSERT_FALSE(blind.contacts.empty());
  options.steering.scanner = true;
  const DriveTrack track = DriveTruth(scene, options);
  EXPECT_TRUE(track.contacts.empty());
  EXPECT_GE(track.scanner_stops, 1);
}

/// It stops with the margin to spare, however late its brakes take hold.
TEST(ClosedDriveTest, AScannerKnowsHowLateTheBrakesTakeHold) {
  for (const double lag_s : {0.0, 0.1, 0.3, 1.0, 2.0}) {
    FakeDriveScene scene(12, 1.5);
    scene.edit().plant.lag_s = scene.edit().driver.lag_s = lag_s;
    scene.edit().things.push_back(
        {"pallet", "goods", {{9, -0.5}, {10, -0.5}, {10, 0.5}, {9, 0.5}}});
    LoopOptions options;
    options.steering.scanner = true;
    options.no_progress_after_s = 5;
    const DriveTrack track = DriveTruth(scene, options);
    EXPECT_EQ(track.end, DriveEnd::kNoProgress) << lag_s;
    EXPECT_GT(track.min_clearance_static_m, options.scanner.margin_m) << lag_s;
  }
}

/// Its wheel needs longer to stand across than anybody may stand.
TEST(ClosedDriveTest, ATricycleThatSteersSlowlyIsNotGivenUp) {
  FakeDriveScene scene;
  scene.edit().plant.kind = VehicleKind::kTricycle;
  scene.edit().plant.max_steering_rad = std::numbers::pi / 2;
  scene.edit().plant.steering_rate_rad_s = 0.1;
  scene.edit().way = {{.kind = WayLeg::Kind::kPause, .duration_s = 0.5},
                      scene.course().way[1],
                      {.kind = WayLeg::Kind::kTurn, .duration_s = 4, .turn_to_rad = 2.5}};
  LoopOptions options;
  options.no_progress_after_s = 8;
  const DriveTrack track = DriveTruth(scene, options);
  EXPECT_EQ(track.end, DriveEnd::kArrived);
  const FloorPose& end = track.samples.back().truth;
  EXPECT_LT((end.position - Eigen::Vector2d(8, 0)).norm(), 0.01) << "it turned on the spot";
  EXPECT_NEAR(end.heading_rad, 2.5, 0.01);
}

TEST(ClosedDriveTest, LostForLongItStopsAndGoesOnWhenFoundAgain) {
  DriftingLocaliser localiser;
  localiser.lost_from_ns = 4'000'000'000;
  localiser.lost_to_ns = 8'000'000'000;
  const DriveTrack track = DriveClosed(FakeDriveScene(), &localiser, {});
  EXPECT_EQ(track.stops, 1);
  EXPECT_GT(track.stopped_s, 2);
  EXPECT_GT(track.lost_s, 3.5);
  EXPECT_LT(track.lost_s, 5);
  EXPECT_EQ(track.end, DriveEnd::kArrived);
}

TEST(ClosedDriveTest, LostForGoodItGivesUpStanding) {
  DriftingLocaliser localiser;
  localiser.lost_from_ns = 4'000'000'000;
  localiser.lost_to_ns = std::numeric_limits<std::int64_t>::max();
  const DriveTrack track = DriveClosed(FakeDriveScene(), &localiser, {});
  EXPECT_EQ(track.end, DriveEnd::kNoProgress);
  EXPECT_NEAR(track.samples.back().speed_mps, 0, 1e-9);
}

TEST(ClosedDriveTest, ARackInTheWayEndsIt) {
  FakeDriveScene scene;
  scene.edit().things.push_back({"rack", "rack", {{5, -1}, {6, -1}, {6, 1}, {5, 1}}});
  const DriveTrack track = DriveTruth(scene);
  EXPECT_EQ(track.end, DriveEnd::kContact);
  ASSERT_EQ(track.contacts.size(), 1u);
  EXPECT_EQ(track.contacts[0].with, "rack");
  EXPECT_NEAR(track.contacts[0].vehicle.position.x(), 4.3, 0.01);
  EXPECT_NEAR(track.contacts[0].speed_mps, 0.8, 0.05);
  EXPECT_EQ(track.min_clearance_static_m, 0);
}

TEST(ClosedDriveTest, SomebodyInTheWayIsTouchedOnceAndTheDriveGoesOn) {
  FakeDriveScene scene;
  scene.Add({"walker", "person"}, {5, 0}, {0, 0});
  const DriveTrack track = DriveTruth(scene);
  EXPECT_EQ(track.end, DriveEnd::kArrived);
  ASSERT_EQ(track.contacts.size(), 1u);
  EXPECT_EQ(track.contacts[0].object_class, "person");
  EXPECT_EQ(track.min_clearance_person_m, 0);
}

TEST(ClosedDriveTest, ClearanceIsThatOfTheFootprintInPassing) {
  FakeDriveScene scene;
  scene.Add({"walker", "person"}, {5, 1}, {0, 0});
  const DriveTrack track = DriveTruth(scene);
  EXPECT_TRUE(track.contacts.empty());
  EXPECT_NEAR(track.min_clearance_person_m, 1 - 0.3 - 0.25, 0.01);
}

TEST(ClosedDriveTest, WhoYieldsWaitsAndIsNotTouched) {
  FakeDriveScene blind, yielding;
  blind.Add({"walker", "person"}, {4, 4}, {0, -0.8});
  yielding.Add({"walker", "person", true, 1.5}, {4, 4}, {0, -0.8});
  EXPECT_EQ(DriveTruth(blind).contacts.size(), 1u);
  const DriveTrack track = DriveTruth(yielding);
  EXPECT_TRUE(track.contacts.empty());
  EXPECT_GT(track.min_clearance_person_m, 0.4);
}

TEST(ClosedDriveTest, AScannerPreventsWhatWouldHaveHappened) {
  FakeDriveScene scene;
  scene.Add({"walker", "person"}, {5, -1.2}, {0, 0.15});
  LoopOptions options;
  EXPECT_EQ(DriveTruth(scene, options).contacts.size(), 1u);
  options.steering.scanner = true;
  const DriveTrack track = DriveTruth(scene, options);
  EXPECT_TRUE(track.contacts.empty());
  EXPECT_GE(track.scanner_stops, 1);
  EXPECT_GT(track.stopped_s, 0.5);
  EXPECT_EQ(track.end, DriveEnd::kArrived);
}

/// Somebody who stands in the field for good is no other stop because the system is lost meanwhile;
/// and the system was lost.
TEST(ClosedDriveTest, AScannerHoldsWhoIsLostBeforeAPerson) {
  FakeDriveScene scene(8, 0.8);
  scene.Add({"stands", "person"}, {2.2, 0}, {0, 0});
  LoopOptions options;
  options.steering.scanner = true;
  options.no_progress_after_s = 8;
  DriftingLocaliser always, blinks;
  blinks.lost_from_ns = 6'000'000'000;
  blinks.lost_to_ns = 9'000'000'000;
  const DriveTrack held = DriveClosed(scene, &always, options);
  const DriveTrack track = DriveClosed(scene, &blinks, options);
  EXPECT_GE(held.scanner_stops, 1);
  EXPECT_EQ(track.scanner_stops, held.scanner_stops);
  EXPECT_EQ(track.min_clearance_person_m, held.min_clearance_person_m);
  EXPECT_GT(track.lost_s, 2.5);
  EXPECT_LT(track.lost_s, 3.5);
}

TEST(ClosedDriveTest, ZonesAreHeldByTheTrueVehicle) {
  FakeDriveScene scene;
  scene.edit().zones = {{"slow", {2, -1}, {3, 1}, 0.3}, {"far", {2, 3}, {3, 4}, 0}};
  const DriveTrack track = DriveTruth(scene);
  ASSERT_EQ(track.violations.size(), 1u);
  EXPECT_EQ(track.violations[0].zone, "slow");
}

TEST(ClosedDriveTest, AskedFromFrameToFrameItIsTheSameDrive) {
  const FakeDriveScene scene;
  for (const QueueRule queue : {QueueRule::kNewest, QueueRule::kDrop, QueueRule::kPipeline}) {
    LoopOptions options = At(120);
    options.steering.queue = queue;
    DriftingLocaliser one(0.01), other(0.01);
    ClosedDrive drive(scene, options);
    int shown = 0;
    while (const Exposure* frame = drive.Next()) {
      EXPECT_EQ(drive.track().frames_shown, ++shown);
      EXPECT_EQ(drive.Next(), frame);  // the same one until something is told of it
      EXPECT_LE(frame->stamp_ns, drive.Now().stamp_ns);
      drive.Tell(one.Locate(*frame));
    }
    EXPECT_EQ(drive.Next(), nullptr);
    EXPECT_THROW(drive.Tell(std::nullopt), std::logic_error);
    EXPECT_EQ(drive.track(), DriveClosed(scene, &other, options));
  }
}

TEST(ClosedDriveTest, ASampleIsTakenEveryFiftyMilliseconds) {
  const std::vector<DriveSample> samples = DriveTruth(FakeDriveScene(), At(60)).samples;
  ASSERT_GT(samples.size(), 20u);
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    EXPECT_EQ(samples[k].stamp_ns, static_cast<std::int64_t>(k) * 50'000'000);
  }
  const std::int64_t last = samples.back().stamp_ns - samples.end()[-2].stamp_ns;
  EXPECT_TRUE(0 < last && last <= 50'000'000) << last;
}

TEST(ClosedDriveTest, ShownOnlyASystemDoesNotSteer) {
  LoopOptions options;
  options.steering.steered_by_truth = true;
  DriftingLocaliser drifting(0.05);
  const DriveTrack track = DriveClosed(FakeDriveScene(), &drifting, options);
  EXPECT_LT(std::abs(track.samples.back().truth.position.y()), 2e-3);
  EXPECT_GT(drifting.seen.size(), 100u);
}

void LetAnswer(Server* server, Localiser* localiser) {
  if (const Exposure* asked = server->asked()) server->Tell(localiser->Locate(*asked));
}

TEST(ServerTest, FramesThatArriveWhileItWorksAreDroppedByTheRule) {
  const FakeDriveScene scene;
  const auto seen = [&](QueueRule rule, double ms) {
    DriftingLocaliser localiser;
    Server server(rule, [=](std::int64_t) { return std::llround(1e6 * ms); });
    for (std::int64_t k = 0; k < 20; ++k) {
      Exposure exposure{.id = k, .stamp_ns = scene.Stamp(k)};
      server.Due(exposure.stamp_ns);
      LetAnswer(&server, &localiser);
      server.Offer(exposure);
      LetAnswer(&server, &localiser);
    }
    return localiser.seen.size();
  };
  EXPECT_EQ(seen(QueueRule::kNewest, 0), 20u);
  EXPECT_EQ(seen(QueueRule::kNewest, 50), 20u);
  EXPECT_EQ(seen(QueueRule::kNewest, 100), 10u);
  EXPECT_EQ(seen(QueueRule::kDrop, 60), 10u);
  EXPECT_EQ(seen(QueueRule::kPipeline, 500), 20u);
}

TEST(ServerTest, AnAnswerIsDueItsLatencyAfterTheSystemCouldBegin) {
  DriftingLocaliser localiser;
  Server server(QueueRule::kNewest, [](std::int64_t) { return 70'000'000; });
  server.Offer({.id = 0, .stamp_ns = 0});
  EXPECT_TRUE(server.Due(80'000'000).empty());  // nobody has said anything of it
  LetAnswer(&server, &localiser);
  server.Offer({.id = 1, .stamp_ns = 50'000'000});
  EXPECT_TRUE(server.Due(69'999'999).empty());
  ASSERT_EQ(server.Due(70'000'000).size(), 1u);
  EXPECT_EQ(server.NextDue(), 140'000'000);
  EXPECT_EQ(server.asked()->id, 1);
  LetAnswer(&server, &localiser);
  EXPECT_EQ(server.Due(140'000'000).at(0).frame_ns, 50'000'000);
}

TEST(ContactWatchTest, AThinPostIsNotJumpedOverBetweenTwoInstants) {
  FakeDriveScene scene;
  scene.edit().things.push_back(
      {"post", "column", {{3, 0}, {3.002, 0}, {3.002, 0.002}, {3, 0.002}}});
  DriveTrack track;
  ContactWatch watch(scene.course(), &track);
  watch.See({.stamp_ns = 0, .vehicle = {}, .speed_mps = 9, .actors = {}}, 0, 0);
  watch.See({.stamp_ns = 1, .vehicle = {{6, 0}, 0}, .speed_mps = 9, .actors = {}}, 6, 0);
  EXPECT_EQ(track.contacts.size(), 1u);
}

TEST(ContactWatchTest, WhoTouchesTheStandingVehicleAndIsDrivenIntoIsACollision) {
  FakeDriveScene scene;
  scene.Add({"walker", "person"}, {0.9, 0}, {0, 0});
  DriveTrack track;
  ContactWatch watch(scene.course(), &track);
  const std::vector<Capsule> there = {scene.ActorAt(0, 0)};
  watch.See({.stamp_ns = 0, .vehicle = {}, .speed_mps = 0, .actors = there}, 0, 0);
  watch.See({.stamp_ns = 1, .vehicle = {}, .speed_mps = 0, .actors = there}, 0, 0);
  ASSERT_EQ(track.contacts.size(), 1u);
  watch.See({.stamp_ns = 2, .vehicle = {{0.1, 0}, 0}, .speed_mps = 0.5, .actors = there}, 0.1, 0);
  watch.See({.stamp_ns = 3, .vehicle = {{0.2, 0}, 0}, .speed_mps = 0.5, .actors = there}, 0.1, 0);
  watch.See({.stamp_ns = 4, .vehicle = {{0.2, 0}, 0}, .speed_mps = 0, .actors = there}, 0, 0);
  ASSERT_EQ(track.contacts.size(), 2u);
  EXPECT_EQ(track.contacts[1].speed_mps, 0.5);
}

TEST(ContactWatchTest, ZonesOfOneNameAreApart) {
  FakeDriveScene scene;
  scene.edit().zones = {{"slow", {-1, -1}, {1, 1}, 0.3}, {"slow", {20, -1}, {21, 1}, 0.3}};
  DriveTrack track;
  ContactWatch watch(scene.course(), &track);
  for (std::int64_t k = 0; k < 5; ++k) {
    watch.See({.stamp_ns = k, .vehicle = {}, .speed_mps = 0.9, .actors = {}}, 0, 0);
  }
  EXPECT_EQ(track.violations.size(), 1u);
}

TEST(SteeringTest, ItsValuesAreChecked) {
  EXPECT_EQ(Validate(Steering{}), "");
  EXPECT_NE(Validate(Steering{.latency_ms = -1}), "");
  EXPECT_EQ(Validate(Steering{.latency_profile_ms = {1, 10'001}}),
            "a latency of the profile is 10001 ms, expected 0 to 10000");
  EXPECT_EQ(Validate(Steering{.latency_profile_ms = {1, 2}}), "");
  EXPECT_NE(Validate(Steering{.latency_ms = 50, .latency_profile_ms = {1, 2}}), "")
      << "the profile alone would have an effect";
  EXPECT_EQ(Validate(Steering{.taught = true}), "");
  EXPECT_NE(Validate(Steering{.steered_by_truth = true, .taught = true}), "");
}

}  // namespace
}  // namespace aisle
