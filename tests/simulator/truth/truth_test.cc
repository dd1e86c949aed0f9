#include "simulator/truth/truth.h"

#include <gtest/gtest.h>

#include "simulator/camera/pixel_rays.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// A box of one metre that stands 4 m ahead of the camera and moves sideways, in front of a wall.
struct Stage {
  double speed = 1;          ///< m/s, along world y
  bool screen = false;       ///< a second mover hides the left half of the box
  double angular_speed = 0;  ///< rad/s about the box's own vertical axis
};

WorldParts Build(const Stage& stage) {
  WorldParts parts;
  parts.instances = {{"nothing", ObjectClass::kNone, false},
                     {"wall", ObjectClass::kWall, false},
                     {"box", ObjectClass::kAgv, true},
                     {"screen", ObjectClass::kPerson, true}};
  parts.materials.resize(1);
  parts.lights.push_back({{0, 0, 5}, {1, 0, 0}, {0, -1, 0}, 1});
  test::MeshBuilder wall, box, screen;
  wall.Quad({10, 50, -50}, {0, -100, 0}, {0, 0, 100}, 0, 1);
  parts.statics = {wall.mesh, wall.instances};
  box.Box({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}, 0, 2);
  screen.Box({-0.01f, 0, -2}, {0.01f, 2, 2}, 0, 3);
  parts.mover_meshes = {box.mesh};
  if (stage.screen) parts.mover_meshes.push_back(screen.mesh);
  parts.at = [meshes = parts.mover_meshes, stage](std::int64_t stamp_ns) {
    Snapshot snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
    const std::array<Eigen::Vector3f, 2> places = {
        Eigen::Vector3f(4.5f,
                        static_cast<float>(1e-9 * static_cast<double>(stamp_ns) * stage.speed), 0),
        Eigen::Vector3f(2, 0, 0)};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      MoverState mover;
      mover.instance = static_cast<std::uint16_t>(2 + i);
      mover.T_world_object.translation() = places[i].cast<double>();
      mover.velocity_mps = i == 0 ? Eigen::Vector3d(0, stage.speed, 0) : Eigen::Vector3d::Zero();
      for (const Eigen::Vector3f& p : meshes[i].positions) {
        Eigen::Vector3f spin = Eigen::Vector3f::Zero();
        if (i == 0)
          spin = Eigen::Vector3f(-p.y(), p.x(), 0) * static_cast<float>(stage.angular_speed);
        mover.positions.push_back(p + places[i]);
        mover.velocities.push_back(mover.velocity_mps.cast<float>() + spin);
      }
      mover.normals = meshes[i].normals;
      snapshot.movers.push_back(std::move(mover));
    }
    return snapshot;
  };
  return parts;
}

struct Seen {
  CameraTruth camera;
  std::vector<ObjectTruth> movers;
};

Seen Look(WorldParts parts, float threshold) {
  const World world(std::move(parts));
  const Tracer tracer(world, {});
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  const std::array views = {CameraView(rays, test::LookAlong({0, 0, 0}, 0))};
  const Instant instant = tracer.Pose(world.At(0));
  std::vector<HitImage> hits;
  TraceViews(instant, views, {}, &hits);
  const MovingNow moving(world, instant.snapshot(), {.threshold_mps = threshold});
  Seen seen{LabelHits(world, instant, hits[0], moving), {}};
  seen.movers = DescribeMovers(instant, views[0], seen.camera);
  return seen;
}

Seen Look(const Stage& stage, float threshold = 0.05f) { return Look(Build(stage), threshold); }

/// The box stands still and has an arm, 0.8 m long, that turns about the shoulder at its left side
/// in the plane across the view.
WorldParts BodyWithWavingArm(float angular_speed) {
  WorldParts parts = Build({.speed = 0});
  test::MeshBuilder body;
  body.Box({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}, 0, 2);
  const std::size_t shoulder_vertex = body.mesh.positions.size();
  body.Box({-0.5f, 0.5f, -0.05f}, {-0.4f, 1.3f, 0.05f}, 0, 2);
  parts.mover_meshes = {body.mesh};
  parts.at = [mesh = body.mesh, shoulder_vertex, angular_speed](std::int64_t stamp_ns) {
    MoverState mover;
    mover.instance = 2;
    mover.T_world_object.translation() = Eigen::Vector3d(4.5, 0, 0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Eigen::Vector3f& p = mesh.positions[i];
      mover.positions.push_back(p + Eigen::Vector3f(4.5f, 0, 0));
      const float turning = i < shoulder_vertex ? 0 : angular_speed;
      mover.velocities.push_back(Eigen::Vector3f(0, -p.z(), p.y() - 0.5f) * turning);
    }
    mover.normals = mesh.normals;
    Snapshot snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
    snapshot.movers.push_back(std::move(mover));
    return snapshot;
  };
  return parts;
}

TEST(Truth, BoxIsWhereTheCameraModelPutsIt) {
  const Seen seen = Look({});
  ASSERT_EQ(seen.movers.size(), 1u);
  const ObjectTruth& box = seen.movers[0];
  // Its front face stands at z = 4 m and reaches 0.5 m to each side.
  const StereoCamera c;
  const double half = c.fx * 0.5 / 4;
  EXPECT_NEAR(box.box_visible.x, c.cx - half, 1);
  EXPECT_NEAR(box.box_visible.br().x, c.cx + half, 1);
  EXPECT_NEAR(box.box_visible.y, c.cy - half, 1);
  EXPECT_NEAR(box.box_visible.br().y, c.cy + half, 1);
  EXPECT_EQ(box.box_full, box.box_visible);
  EXPECT_EQ(box.visible_fraction, 1);
  EXPECT_NEAR(box.visible_pixels, 4 * half * half, 6 * half);
  EXPECT_TRUE(box.extent_m.isApproxToConstant(1, 1e-6));
  EXPECT_TRUE(box.center_m.isApprox(Eigen::Vector3d(4.5, 0, 0), 1e-6));
  EXPECT_NEAR(seen.camera.depth(252, 367), 4, 1e-5);
  EXPECT_NEAR(seen.camera.depth(10, 10), 10, 1e-5);
  EXPECT_EQ(seen.camera.instance(252, 367), 2);
  EXPECT_EQ(seen.camera.object_class(252, 367), static_cast<int>(ObjectClass::kAgv));
}

TEST(Truth, DynamicIsTheSurfacesOwnSpeedAgainstTheThreshold) {
  const Seen moving = Look({.speed = 1});
  EXPECT_EQ(moving.movers[0].dynamic_pixels, moving.movers[0].visible_pixels);
  EXPECT_EQ(cv::countNonZero(moving.camera.dynamic), moving.movers[0].visible_pixels);
  const Seen creeping = Look({.speed = 0.04});
  EXPECT_EQ(cv::countNonZero(creeping.camera.dynamic), 0);
  EXPECT_EQ(cv::countNonZero(creeping.camera.actor), creeping.movers[0].visible_pixels);
  EXPECT_GT(cv::countNonZero(Look({.speed = 0.04}, 0.03f).camera.dynamic), 0);
}

TEST(Truth, OfATurningThingOnlyTheFastPartIsDynamic) {
  // Front face x = -0.5: speed = ω·√(0.25 + y²); 0.6 m/s is passed where |y| > 0.33 at ω = 1.
  const Seen seen = Look({.speed = 0, .angular_speed = 1}, 0.6f);
  const StereoCamera c;
  const auto at = [&](double y) {
    return seen.camera.dynamic(252, static_cast<int>(c.cx - c.fx * y / 4));
  };
  EXPECT_EQ(at(0.0), 0);
  EXPECT_EQ(at(0.28), 0);
  EXPECT_EQ(at(0.4), 255);
  EXPECT_EQ(at(-0.4), 255);
}

TEST(Truth, AWavingArmIsDynamicAndTheBodyThatStandsIsNot) {
  // At 1 rad/s the arm passes 0.05 m/s within 0.05 m of the shoulder.
  const Seen seen = Look(BodyWithWavingArm(1), 0.05f);
  const StereoCamera c;
  const auto pixel = [&](const cv::Mat1b& image, double y) {
    return image(252, static_cast<int>(std::lround(c.cx - c.fx * y / 4)));
  };
  for (const double y : {-0.45, 0.0, 0.45}) EXPECT_EQ(pixel(seen.camera.dynamic, y), 0) << y;
  for (const double y : {0.6, 0.9, 1.25}) EXPECT_EQ(pixel(seen.camera.dynamic, y), 255) << y;
  for (const double y : {0.0, 0.9}) EXPECT_EQ(pixel(seen.camera.actor, y), 255) << y;
  EXPECT_EQ(cv::countNonZero(Look(BodyWithWavingArm(0), 0.05f).camera.dynamic), 0);
}

/// Pillars that stand still in a row behind the camera, `before` of them, and then two that it
/// sees, the nearer one before half of the other.
WorldParts TwoAmongMany(std::size_t before) {
  WorldParts parts = Build({.speed = 0});
  parts.mover_meshes.clear();
  std::vector<Eigen::Vector3f> places(before, Eigen::Vector3f(-20, 0, 0));
  places.emplace_back(3, 0.5f, 0);
  places.emplace_back(5, 0, 0);
  std::vector<MoverState> states;
  for (const Eigen::Vector3f& place : places) {
    test::MeshBuilder pillar;
    pillar.Box({-0.3f, -0.5f, -1}, {0.3f, 0.5f, 1}, 0, 2);
    MoverState state;
    state.instance = static_cast<std::uint16_t>(2 + states.size());
    for (const Eigen::Vector3f& p : pillar.mesh.positions) state.positions.push_back(p + place);
    state.normals = pillar.mesh.normals;
    state.velocities.assign(state.positions.size(), Eigen::Vector3f::Zero());
    states.push_back(std::move(state));
    parts.instances.resize(2 + states.size(), {"pillar", ObjectClass::kPerson, true});
    parts.mover_meshes.push_back(std::move(pillar.mesh));
  }
  parts.at = [states](std::int64_t stamp_ns) {
    return Snapshot{.stamp_ns = stamp_ns, .movers = states, .light_scale = {1}};
  };
  return parts;
}

TEST(Truth, OfTwoIsTheSameHoweverManyOthersThereAre) {
  const Seen alone = Look(TwoAmongMany(0), 0.05f);
  ASSERT_EQ(alone.movers.size(), 2u);
  EXPECT_LT(alone.movers[1].visible_fraction, 0.8);
  for (const std::size_t before : {61u, 62u, 63u, 100u, 125u}) {
    const Seen seen = Look(TwoAmongMany(before), 0.05f);
    ASSERT_EQ(seen.movers.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(seen.movers[i].instance, alone.movers[i].instance + before);
      EXPECT_EQ(seen.movers[i].box_full, alone.movers[i].box_full) << before;
      EXPECT_EQ(seen.movers[i].visible_fraction, alone.movers[i].visible_fraction) << before;
    }
  }
  EXPECT_THROW(World(TwoAmongMany(126)), std::invalid_argument);
}

TEST(Truth, HiddenHalfCountsInTheFullBoxOnly) {
  const Seen seen = Look({.screen = true});
  ASSERT_EQ(seen.movers.size(), 2u);
  const ObjectTruth& box = seen.movers[0];
  EXPECT_NEAR(box.visible_fraction, 0.5, 0.01);
  EXPECT_NEAR(box.box_visible.width, box.box_full.width / 2, 1.5);
  EXPECT_EQ(box.box_visible.br(), box.box_full.br());
}

}  // namespace
}  // namespace aisle::sim
