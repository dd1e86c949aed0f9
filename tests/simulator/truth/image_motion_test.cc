#include "simulator/truth/image_motion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/simulator/truth/one_mover.h"

namespace aisle::sim {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Vector3d;

/// A long lens: over its narrow picture a turn moves all pixels nearly alike.
const StereoCamera kCamera = {
    .width = 200, .height = 160, .fx = 2000, .fy = 2000, .cx = 99.5, .cy = 79.5};
constexpr double kExposure_s = 0.02;

/// Image motion of a wall at 10 m with a board at 4 m, which covers a third of the picture and goes
/// to the left (along y) at `board_mps`.
double Motion(double board_mps, const RigAround& rig_at) {
  test::MeshBuilder board;
  board.Quad({4, -0.07f, -1}, {0, 0.14f, 0}, {0, 0, 2}, 0, 2);
  const World world(test::BeforeAWall({test::Rigid(board.mesh, [board_mps](double t) {
    return Isometry3d(Eigen::Translation3d(0, board_mps * t, 0));
  })}));
  const Tracer tracer(world, {});
  const PixelRays rays = MakePixelRays(kCamera);
  const CameraView view(rays, rig_at(0));
  const Instant instant = tracer.Pose(world.At(0));
  return ImageMotion(world, instant, kCamera, view, test::Trace(instant, view), rig_at,
                     kExposure_s);
}

Isometry3d At(double left_m, double turn_rad = 0) {
  return test::LookAlong({0, left_m, 0}, turn_rad);
}

TEST(ImageMotion, IsWhatProjectionMakesOfAWay) {
  constexpr double kSpeed = 1.5, kWay_px = 2000 * kSpeed * kExposure_s;  // at a depth of 1 m
  const auto rests = [](double) { return At(0); };
  const auto goes = [](double t) { return At(kSpeed * t); };
  EXPECT_EQ(Motion(0, rests), 0);
  EXPECT_NEAR(Motion(kSpeed, rests), kWay_px / 4, 1e-3);
  EXPECT_NEAR(Motion(-kSpeed, rests), kWay_px / 4, 1e-3);
  EXPECT_NEAR(Motion(0, goes), kWay_px / 4, 1e-3);
  EXPECT_NEAR(Motion(kSpeed, goes), kWay_px / 10, 1e-3) << "it follows the board: the wall moves";
  EXPECT_NEAR(Motion(-kSpeed, goes), 2 * kWay_px / 4, 1e-3) << "they meet";
}

TEST(ImageMotion, OfATurnIsItsAngle) {
  const double turn_px = kCamera.fx * 0.5 * kExposure_s;
  EXPECT_NEAR(Motion(0, [](double t) { return At(0, 0.5 * t); }), turn_px, 0.01 * turn_px);
  // All the way there and back again, twice.
  const auto swing = [](double t) {
    return At(0, 2e-3 * std::sin(4 * std::numbers::pi * t / kExposure_s));
  };
  const double swing_px = kCamera.fx * 8 * 2e-3;
  EXPECT_NEAR(Motion(0, swing), swing_px, 0.01 * swing_px);
}

/// Light that does `light(seconds)` and a board at rest.
double LightMotionOf(const std::function<void(double, Snapshot*)>& light) {
  WorldParts parts = test::BeforeAWall({});
  parts.has_beams = true;
  parts.at = [light](std::int64_t stamp_ns) {
    Snapshot snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
    snapshot.beams.resize(2);
    for (Beam& beam : snapshot.beams) beam.power = 3;
    light(1e-9 * static_cast<double>(stamp_ns), &snapshot);
    return snapshot;
  };
  const World world(std::move(parts));
  constexpr std::int64_t kNow_ns = 1'000'000'000;
  return LightMotion(world, world.At(kNow_ns), kCamera, kExposure_s);
}

TEST(LightMotion, IsThatOfTheBeamThatTurnsMost) {
  EXPECT_EQ(LightMotionOf([](double, Snapshot*) {}), 0);
  const double moved = LightMotionOf([](double t, Snapshot* snapshot) {
    const auto toward = [](double angle) {
      return Eigen::Vector3f(Vector3d(std::cos(angle), std::sin(angle), 0).cast<float>());
    };
    snapshot->beams[0].toward = toward(1.5 * t);
    snapshot->beams[1].toward = toward(0.4 - 6 * t);
  });
  EXPECT_NEAR(moved, kCamera.fx * 6 * kExposure_s, 0.05);
}

TEST(LightMotion, IsEndlessWhereALightChangesWithinTheExposure) {
  for (const bool is_beam : {false, true}) {
    const auto switched = [&](double from_s) {
      return LightMotionOf([&](double t, Snapshot* snapshot) {
        (is_beam ? snapshot->beams[1].power : snapshot->light_scale[0]) = t < from_s ? 1 : 0.5f;
      });
    };
    for (const double share : {-0.4, 0.4}) {
      EXPECT_TRUE(std::isinf(switched(1 + share * kExposure_s))) << is_beam << ", " << share;
    }
    for (const double share : {-0.6, 0.6}) EXPECT_EQ(switched(1 + share * kExposure_s), 0);
  }
}

}  // namespace
}  // namespace aisle::sim
