// The camera's own motion at each exposure, which smears and shears what it takes.
#include <gtest/gtest.h>

#include "harness/loop/closed_drive.h"
#include "tests/harness/loop/fake_drive_scene.h"

namespace aisle {
namespace {

constexpr double kRadius_m = 3, kSpeed_mps = 0.8, kStart_rad = 1.1, kCamera_s = 0.05;

/// A bend to the left that begins at a heading of its own, on a floor that heaves and rolls the
/// vehicle as time goes.
class BendOnAHeavingFloor : public FakeDriveScene {
 public:
  BendOnAHeavingFloor() : FakeDriveScene(5, kSpeed_mps) {
    Course& course = edit();
    course.start = {{2, -1}, kStart_rad};
    for (WayPoint& point : course.way.back().points) {
      const double turned = point.distance_m / kRadius_m;
      const FloorPose at = AlongArc(course.start, point.distance_m, turned);
      point.position = at.position;
      point.heading_rad = at.heading_rad;
      point.curvature_per_m = 1 / kRadius_m;
    }
  }

  Eigen::Isometry3d RigAt(const FloorPose& vehicle, std::int64_t stamp_ns) const override {
    Eigen::Isometry3d heave = Eigen::Isometry3d::Identity();
    const double s = 1e-9 * static_cast<double>(stamp_ns);
    heave.translation().z() = 0.02 * std::sin(2 * s);
    heave.linear() =
        Eigen::AngleAxisd(0.03 * std::sin(1.5 * s), Eigen::Vector3d::UnitX()).toRotationMatrix();
    return InSpace(vehicle) * heave * course().T_vehicle_rig;
  }
};

class Recording : public TruthLocaliser {
 public:
  std::optional<Eigen::Isometry3d> Locate(const Exposure& exposure) override {
    exposures.push_back(exposure);
    return TruthLocaliser::Locate(exposure);
  }
  std::vector<Exposure> exposures;
};

std::vector<Exposure> Photographed(const DriveScene& scene) {
  Recording recording;
  DriveClosed(scene, &recording, {});
  return recording.exposures;
}

TEST(ExposureMotionTest, IsTheDifferenceOfThePosesAroundItInTheRigsAxes) {
  const std::vector<Exposure> taken = Photographed(BendOnAHeavingFloor());
  ASSERT_GT(taken.size(), 80u);
  double fastest = 0, fastest_turn = 0;
  for (std::size_t k = 1; k + 1 < taken.size(); ++k) {
    const Eigen::Isometry3d &before = taken[k - 1].T_world_rig, &now = taken[k].T_world_rig,
                            &after = taken[k + 1].T_world_rig;
    ASSERT_EQ(taken[k + 1].id, taken[k - 1].id + 2) << "each frame is looked at";
    const Eigen::Vector3d moved = after.translation() - before.translation();
    const Eigen::Vector3d velocity = now.linear().transpose() * moved / (2 * kCamera_s);
    const Eigen::AngleAxisd turned(Eigen::Matrix3d(before.linear().transpose() * after.linear()));
    const Eigen::Vector3d turn_rate = turned.angle() * turned.axis() / (2 * kCamera_s);
    // What a vehicle that speeds up or steers does to a difference over a tenth of a second.
    EXPECT_LT((taken[k].velocity_mps - velocity).norm(), 0.05) << k;
    EXPECT_LT((taken[k].turn_rate_rad_s - turn_rate).norm(), 0.05) << k;
    fastest = std::max(fastest, velocity.norm());
    fastest_turn = std::max(fastest_turn, turn_rate.norm());
  }
  EXPECT_GT(fastest, 0.9 * kSpeed_mps);
  EXPECT_GT(fastest_turn, 0.9 * kSpeed_mps / kRadius_m);
}

/// In the middle of the bend, by hand: z looks ahead, x to the right and y down, and the rig is
/// 0.35 m before the axle, which turns to the left.
TEST(ExposureMotionTest, OnALevelFloorItLooksAheadAndTurnsAboutTheVertical) {
  class Level : public BendOnAHeavingFloor {
   public:
    Eigen::Isometry3d RigAt(const FloorPose& vehicle, std::int64_t stamp_ns) const override {
      return FakeDriveScene::RigAt(vehicle, stamp_ns);
    }
  };
  const std::vector<Exposure> taken = Photographed(Level());
  const Exposure& middle = taken.at(taken.size() / 2);
  const double turn_rate = kSpeed_mps / kRadius_m;
  EXPECT_LT((middle.velocity_mps - Eigen::Vector3d(-0.35 * turn_rate, 0, kSpeed_mps)).norm(), 0.02);
  EXPECT_LT((middle.turn_rate_rad_s - Eigen::Vector3d(0, -turn_rate, 0)).norm(), 0.02);
}

TEST(ExposureMotionTest, WhoStandsOnALevelFloorHasNone) {
  const std::vector<Exposure> taken = Photographed(FakeDriveScene());
  ASSERT_LT(taken[2].stamp_ns, 500'000'000) << "in the pause";
  EXPECT_LT(taken[2].velocity_mps.norm(), 1e-12);
  EXPECT_LT(taken[2].turn_rate_rad_s.norm(), 1e-12);
}

}  // namespace
}  // namespace aisle
