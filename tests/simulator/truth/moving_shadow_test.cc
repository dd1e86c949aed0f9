#include "simulator/truth/moving_shadow.h"

#include <gtest/gtest.h>

#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// A floor under one lamp at the height of 4 m, seen from above; a plate of 1 m hangs at half the
/// height, so that its umbra and penumbra lie under it, and moves at `speed` along x. A second,
/// roof-like static plate can hide the lamp from all of them.
struct Stage {
  float speed = 1;
  bool roof = false;
};

WorldParts Build(const Stage& stage) {
  WorldParts parts;
  parts.instances = {{"nothing", ObjectClass::kNone, false},
                     {"floor", ObjectClass::kFloor, false},
                     {"plate", ObjectClass::kAgv, true}};
  parts.materials.resize(1);
  parts.lights.push_back({{0, 0, 4}, {0.1f, 0, 0}, {0, -0.1f, 0}, 1});
  test::MeshBuilder floor, plate;
  floor.Quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, 0, 1);
  if (stage.roof) floor.Quad({-1, -1, 3}, {2, 0, 0}, {0, 2, 0}, 0, 1);
  plate.Quad({-0.5f, -0.5f, 2}, {1, 0, 0}, {0, 1, 0}, 0, 2);
  parts.statics = {floor.mesh, floor.instances};
  parts.mover_meshes = {plate.mesh};
  parts.at = [mesh = plate.mesh, stage](std::int64_t stamp_ns) {
    Snapshot snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
    MoverState mover;
    mover.instance = 2;
    mover.positions = mesh.positions;
    mover.normals = mesh.normals;
    mover.velocities.assign(mesh.positions.size(), Eigen::Vector3f(stage.speed, 0, 0));
    snapshot.movers.push_back(std::move(mover));
    return snapshot;
  };
  return parts;
}

/// The mask as an camera at (4, 0, 3) sees it that looks down at the floor under the plate.
struct Look {
  cv::Mat1b mask;
  cv::Mat1b shadow_square;  ///< 255 on floor points well inside the shadow, 128 well outside
};

Look LookAt(const Stage& stage) {
  const World world(Build(stage));
  const Tracer tracer(world, {});
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 4, 0, 1.2;
  pose.linear().col(0) = Eigen::Vector3d::UnitY();
  pose.linear().col(2) = Eigen::Vector3d(-4, 0, -1.2).normalized();
  pose.linear().col(1) = pose.linear().col(2).cross(pose.linear().col(0));
  const CameraView view(rays, pose);
  const Instant instant = tracer.Pose(world.At(0));
  std::vector<HitImage> hits;
  TraceViews(instant, std::span(&view, 1), {}, &hits);
  const MovingNow moving(world, instant.snapshot(), {});
  Look look{FindMovingShadows(world, instant, view, hits[0], moving),
            cv::Mat1b(camera.height, camera.width, std::uint8_t{0})};
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const std::size_t i = hits[0].Index(x, y);
      if (hits[0].geometry[i] != 0) continue;
      const Eigen::Vector3f point =
          view.origin + hits[0].t[i] * (view.rotation * rays.At(x, y).homogeneous());
      if (std::abs(point.z()) > 1e-3f) continue;
      // From half the height the shadow is twice the plate; the penumbra is as wide as the lamp.
      const float off = point.head<2>().cwiseAbs().maxCoeff();
      if (off < 0.85f) look.shadow_square(y, x) = 255;
      if (off > 1.15f) look.shadow_square(y, x) = 128;
    }
  }
  return look;
}

TEST(MovingShadow, IsWhereTheLampsRaysThroughThePlateMeetTheFloor) {
  const Look look = LookAt({});
  const cv::Mat1b inside(look.shadow_square == 255), outside(look.shadow_square == 128);
  EXPECT_GT(cv::countNonZero(inside), 5000);
  EXPECT_EQ(cv::countNonZero(inside & ~look.mask), 0);
  EXPECT_EQ(cv::countNonZero(outside & look.mask), 0);
}

TEST(MovingShadow, OfAPlateAtRestIsNone) {
  EXPECT_EQ(cv::countNonZero(LookAt({.speed = 0.01f}).mask), 0);
}

TEST(MovingShadow, IsNoneWhereTheStaticWorldKeepsTheLightAwayAnyhow) {
  EXPECT_EQ(cv::countNonZero(LookAt({.roof = true}).mask), 0);
}

}  // namespace
}  // namespace aisle::sim
