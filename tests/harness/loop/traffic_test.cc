#include "harness/loop/traffic.h"

#include <gtest/gtest.h>

#include "harness/loop/closed_drive.h"
#include "tests/harness/loop/fake_drive_scene.h"

namespace aisle {
namespace {

DriveTrack DriveTruth(const DriveScene& scene) {
  TruthLocaliser truth;
  return DriveClosed(scene, &truth, {});
}

/// A metre ahead, then half a turn; a walker's script leads him to where the nose sweeps meanwhile.
FakeDriveScene TurningBeforeAWalker(bool he_yields) {
  FakeDriveScene scene(1);
  scene.edit().way.push_back(
      {.kind = WayLeg::Kind::kTurn, .duration_s = 5, .turn_to_rad = std::numbers::pi});
  scene.Add({"walker", "person", he_yields, 1.0}, {1.2, 6.5}, {0, -1});
  return scene;
}

TEST(TrafficTest, WhoYieldsWaitsForAVehicleThatTurnsOnTheSpot) {
  EXPECT_FALSE(DriveTruth(TurningBeforeAWalker(false)).contacts.empty());
  const DriveTrack track = DriveTruth(TurningBeforeAWalker(true));
  EXPECT_EQ(track.end, DriveEnd::kArrived);
  EXPECT_TRUE(track.contacts.empty());
  EXPECT_GT(track.min_clearance_person_m, 0.1);
}

TEST(TrafficTest, ATrainWaitsForEachOfItsParts) {
  const auto passes = [](bool trailer_yields) {
    FakeDriveScene scene;
    scene.Add({"tractor", "forklift", true, 1.0}, {4, -2}, {0, 1});
    scene.Add({"trailer", "trailer", trailer_yields, trailer_yields ? 1.2 : 0, 0}, {4, -5}, {0, 1});
    return DriveTruth(scene);
  };
  for (const bool trailer_yields : {false, true}) {
    const DriveTrack track = passes(trailer_yields);
    EXPECT_TRUE(track.contacts.empty());
    EXPECT_GT(track.min_clearance_vehicle_m, 0.2);
    // They stay as far apart as they began.
    for (std::size_t k = 0; k < track.samples.size(); ++k) {
      const Eigen::Vector2d apart = track.actors[0].from[k] - track.actors[1].from[k];
      EXPECT_NEAR(apart.y(), 3, 1e-9);
    }
  }
}

}  // namespace
}  // namespace aisle
