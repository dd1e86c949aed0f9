#include "simulator/truth/moving_shadow.h"

#include <gtest/gtest.h>

#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// A floor under one lamp at the height of 4 m, seen from above; a plate of 1 m hangs at half the
/// height, so that its umbra and penumbra lie under it, and moves at `speed` along x. A second,
/// roof-like plate can hide the lamp from all of them: one that never moves, a mover at rest, or a
/// part at rest of the mover that moves.
struct Stage {
  enum class Roof { kNone, kStatic, kMover, kPart };
  float speed = 1;
  Roof roof = Roof::kNone;
  float lamp = 1;  ///< its radiance
  std::vector<Beam> beams = {};
  float half_shadow_m = 1;  ///< from half the height it is twice the plate
};

/// Where the lamp is.
Beam Spot(float power) {
  Beam beam;
  beam.origin = {0, 0, 4};
  beam.toward = -Eigen::Vector3f::UnitZ();
  beam.power = power;
  beam.cos_inner = 0.75f;
  beam.cos_outer = 0.7f;
  return beam;
}

/// Straight down through a skylight with its middle at x.
Beam Sun(float x, float power) {
  Beam beam;
  beam.kind = Beam::Kind::kSun;
  beam.origin = {x, 0, 4};
  beam.toward = Eigen::Vector3f::UnitZ();
  beam.power = power;
  beam.half_u = {2, 0, 0};
  beam.half_v = {0, -2, 0};
  return beam;
}

WorldParts Build(const Stage& stage) {
  using Roof = Stage::Roof;
  WorldParts parts;
  parts.instances = {{"nothing", ObjectClass::kNone, false},
                     {"floor", ObjectClass::kFloor, false},
                     {"plate", ObjectClass::kAgv, true},
                     {"roof", ObjectClass::kForklift, true}};
  parts.materials.resize(1);
  parts.lights.push_back({{0, 0, 4}, {0.1f, 0, 0}, {0, -0.1f, 0}, stage.lamp});
  parts.has_beams = !stage.beams.empty();
  test::MeshBuilder floor, plate, parked;
  const auto roof = [](test::MeshBuilder* mesh, std::uint16_t instance) {
    mesh->Quad({-1, -1, 3}, {2, 0, 0}, {0, 2, 0}, 0, instance);
  };
  floor.Quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, 0, 1);
  if (stage.roof == Roof::kStatic) roof(&floor, 1);
  plate.Quad({-0.5f, -0.5f, 2}, {1, 0, 0}, {0, 1, 0}, 0, 2);
  if (stage.roof == Roof::kPart) roof(&plate, 2);
  parts.statics = {floor.mesh, floor.instances};
  parts.mover_meshes = {plate.mesh};
  if (stage.roof == Roof::kMover) {
    roof(&parked, 3);
    parts.mover_meshes.push_back(parked.mesh);
  }
  parts.at = [meshes = parts.mover_meshes, stage](std::int64_t stamp_ns) {
    Snapshot snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
    snapshot.beams = stage.beams;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      MoverState mover;
      mover.instance = static_cast<std::uint16_t>(2 + i);
      mover.positions = meshes[i].positions;
      mover.normals = meshes[i].normals;
      for (const Eigen::Vector3f& p : mover.positions) {
        mover.velocities.emplace_back(p.z() > 2.5f ? 0 : stage.speed, 0, 0);
      }
      snapshot.movers.push_back(std::move(mover));
    }
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
      // The penumbra is as wide as the lamp.
      const float off = point.head<2>().cwiseAbs().maxCoeff() / stage.half_shadow_m;
      if (off < 0.85f) look.shadow_square(y, x) = 255;
      if (off > 1.15f) look.shadow_square(y, x) = 128;
    }
  }
  return look;
}

void ExpectShadowSquare(const Stage& stage) {
  const Look look = LookAt(stage);
  const cv::Mat1b inside(look.shadow_square == 255), outside(look.shadow_square == 128);
  EXPECT_GT(cv::countNonZero(inside), 2000);
  EXPECT_EQ(cv::countNonZero(inside & ~look.mask), 0);
  EXPECT_EQ(cv::countNonZero(outside & look.mask), 0);
}

int ShadowPixels(const Stage& stage) { return cv::countNonZero(LookAt(stage).mask); }

TEST(MovingShadow, IsWhereTheLampsRaysThroughThePlateMeetTheFloor) { ExpectShadowSquare({}); }

TEST(MovingShadow, IsWhereBeamsThroughThePlateMeetTheFloor) {
  ExpectShadowSquare({.lamp = 1e-6f, .beams = {Spot(1)}});
  ExpectShadowSquare({.lamp = 1e-6f, .beams = {Sun(0, 1)}, .half_shadow_m = 0.5f});
}

/// A second sun shines past the plate onto the floor under it, with 0.6 of its power.
TEST(MovingShadow, IsNoneWhereTheLightThatIsLostIsASmallShare) {
  Beam aside = Sun(16.0f / 3, 1);
  aside.toward = {0.8f, 0, 0.6f};
  aside.half_u = {1, 0, 0};
  aside.half_v = {0, -1, 0};
  const Stage more{.lamp = 1e-6f, .beams = {Sun(0, 0.04f), aside}, .half_shadow_m = 0.5f};
  ExpectShadowSquare(more);  // 6 %
  Stage less = more;
  less.beams[0].power = 0.02f;  // 3 %
  EXPECT_EQ(ShadowPixels(less), 0);
  EXPECT_EQ(ShadowPixels({.lamp = 0, .beams = {Sun(20, 1)}}), 0) << "it shines elsewhere";
}

TEST(MovingShadow, OfAPlateAtRestIsNone) {
  EXPECT_EQ(ShadowPixels({.speed = 0.01f}), 0);
  EXPECT_EQ(ShadowPixels({.speed = 0.01f, .beams = {Spot(1), Sun(0, 1)}}), 0);
}

TEST(MovingShadow, IsNoneWhereWhatRestsKeepsTheLightAwayAnyhow) {
  for (const auto roof : {Stage::Roof::kStatic, Stage::Roof::kMover, Stage::Roof::kPart}) {
    EXPECT_EQ(ShadowPixels({.roof = roof}), 0);
    EXPECT_EQ(ShadowPixels({.roof = roof, .beams = {Spot(1)}}), 0);
  }
}

}  // namespace
}  // namespace aisle::sim
