#include <gtest/gtest.h>

#include "simulator/shade/light/direct_light.h"
#include "simulator/shade/light/form_factor.h"
#include "simulator/shade/pass/mover_light.h"
#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// The hall whose truck wears a second skin under the one that is seen, first in the mesh, as a
/// body comes before its clothes.
WorldParts WithLayerBelow(WorldParts parts) {
  test::MeshBuilder truck;
  truck.Box({-0.98f, -0.48f, 0.12f}, {0.98f, 0.48f, 1.88f}, 4, 6, 1.0f);
  truck.Box({-1, -0.5f, 0.1f}, {1, 0.5f, 1.9f}, 4, 6, 1.0f);
  parts.mover_meshes[1] = truck.mesh;
  parts.at = [mesh = truck.mesh, plain = parts.at](std::int64_t stamp_ns) {
    Snapshot snapshot = plain(stamp_ns);
    MoverState& state = snapshot.movers[1];
    const Eigen::Vector3f place = state.T_world_object.translation().cast<float>();
    state.positions.clear();
    for (const Eigen::Vector3f& p : mesh.positions) state.positions.push_back(p + place);
    state.velocities.assign(mesh.positions.size(), state.velocities.front());
    state.normals = mesh.normals;
    return snapshot;
  };
  return parts;
}

cv::Mat1f Shaded(const World& world, cv::Mat1b* truck) {
  StereoCamera camera;
  camera.width = 160;
  camera.height = 120;
  camera.fx = camera.fy = 110;
  camera.cx = 79.5;
  camera.cy = 59.5;
  const Tracer tracer(world, {});
  const PixelRays rays = MakePixelRays(camera);
  const std::array views = {CameraView(rays, test::LookAlong({10.2, 0.2, 1.2}, 0))};
  const Instant instant = tracer.Pose(world.At(2'000'000'000));
  std::vector<HitImage> hits;
  TraceViews(instant, views, {}, &hits);
  truck->create(camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      (*truck)(y, x) = hits[0].geometry[hits[0].Index(x, y)] == 2 ? 255 : 0;
    }
  }
  return Shader(world, tracer, {.statics = {}, .antialias = false}).Shade(instant, views, hits)[0];
}

TEST(LightOnMovers, ALayerThatNobodySeesTakesNoLight) {
  const WorldParts plain = test::Hall({.boxes = 0, .lights = 8});
  cv::Mat1b truck, same;
  const cv::Mat1f expected = Shaded(World(plain), &truck);
  const cv::Mat1f layered = Shaded(World(WithLayerBelow(plain)), &same);
  ASSERT_GT(cv::countNonZero(truck), 1000);
  EXPECT_EQ(cv::countNonZero(truck != same), 0);
  EXPECT_NEAR(cv::mean(layered, truck)[0], cv::mean(expected, truck)[0],
              0.03 * cv::mean(expected, truck)[0]);
}

/// The hall's figure and truck, 1.5 mm on, as one who stands sways.
Snapshot Swayed(const World& world, float way) {
  Snapshot snapshot = world.At(2'000'000'000);
  for (MoverState& mover : snapshot.movers) {
    for (Eigen::Vector3f& position : mover.positions) position += Eigen::Vector3f(way, -way, 0);
  }
  return snapshot;
}

/// Mover light of the test hall by itself.
struct LitHall {
  LitHall() : world(test::Hall({.boxes = 400, .lights = 8})), tracer(world, {}) {
    for (const TriangleMesh& mesh : world.mover_meshes())
      grids.push_back(MakeLightGrid(mesh, 0.08f));
    light = std::make_unique<MoverLight>(world, grids, MoverLightOptions{});
  }
  std::vector<float> At(const Snapshot& snapshot, std::span<const std::uint8_t> wanted) const {
    const Instant instant = tracer.Pose(snapshot);
    return light->At(instant, 0, LightVolume(), wanted, 0.004f);
  }

  World world;
  Tracer tracer;
  std::vector<LightGrid> grids;
  std::unique_ptr<MoverLight> light;
};

TEST(LightOnMovers, IsTheSameWhateverElseIsSeen) {
  const LitHall hall;
  const Snapshot snapshot = Swayed(hall.world, 0);
  const std::size_t points = hall.grids[0].points.size();
  const std::vector<float> all = hall.At(snapshot, std::vector<std::uint8_t>(points, 1));
  std::vector<std::uint8_t> some(points);
  for (std::size_t i = 0; i < points; i += 7) some[i] = 1;
  const std::vector<float> few = hall.At(snapshot, some);
  for (std::size_t i = 0; i < points; ++i) EXPECT_EQ(few[i], some[i] ? all[i] : -1);
}

TEST(LightOnMovers, HardlyChangesOnOneWhoHardlyMoves) {
  const LitHall hall;
  const std::vector<std::uint8_t> wanted(hall.grids[0].points.size(), 1);
  const std::vector<float> before = hall.At(Swayed(hall.world, 0), wanted);
  const std::vector<float> after = hall.At(Swayed(hall.world, 1.5e-3f), wanted);
  double squares = 0, light = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    squares += std::pow(after[i] - before[i], 2);
    light += before[i];
  }
  const auto count = static_cast<double>(wanted.size());
  // Shadow rays dealt anew for each picture change it by 5 % and more.
  EXPECT_LT(std::sqrt(squares / count), 0.01 * light / count);
}

/// A hall with one lamp and a crate that a fork has lifted so high.
WorldParts LiftedCrate(float low_z, float high_z) {
  WorldParts parts = test::Hall({.boxes = 0, .movers = false, .lights = 0});
  parts.lights = {{{15, 0, 4.6f}, {0.75f, 0, 0}, {0, -0.15f, 0}, 1}};
  test::MeshBuilder crate;
  crate.Box({14.6f, 0.2f, low_z}, {15.4f, 0.8f, high_z}, 4, 5);
  parts.mover_meshes = {crate.mesh};
  parts.at = [mesh = crate.mesh](std::int64_t stamp_ns) {
    MoverState state;
    state.instance = 5;
    state.positions = mesh.positions;
    state.normals = mesh.normals;
    state.velocities.assign(mesh.positions.size(), Eigen::Vector3f::Zero());
    return Snapshot{.stamp_ns = stamp_ns, .movers = {state}, .light_scale = {1}};
  };
  return parts;
}

/// What of the floor it shades is a matter of where it is, not of where its frame has its origin.
TEST(LightOnMovers, IsTheSameWhereverTheFrameOfACarriedThingBegins) {
  const World world(LiftedCrate(1.1f, 1.6f));
  const Tracer tracer(world, {});
  const std::vector<LightGrid> grids = {MakeLightGrid(world.mover_meshes()[0], 0.08f)};
  const MoverLight light(world, grids, {});
  LightVolume volume(Eigen::AlignedBox3f(Eigen::Vector3f(10, -4, 0), Eigen::Vector3f(20, 4, 4)), 1);
  for (std::size_t i = 0; i < volume.size(); ++i) {
    volume.Set(i, {.mean = 0.1f, .slope = {0, 0, -0.05f}, .weight = 1});
  }
  const auto lit = [&](double origin_z) {
    Snapshot snapshot = world.At(0);
    snapshot.movers[0].T_world_object.translation() << 15, 0.5, origin_z;
    return light.At(tracer.Pose(std::move(snapshot)), 0, volume,
                    std::vector<std::uint8_t>(grids[0].points.size(), 1), 0.004f);
  };
  EXPECT_EQ(lit(0), lit(1.1));
}

TEST(LightOnMovers, IsExactCloseUnderALampToo) {
  const World world(LiftedCrate(3.4f, 4.2f));
  const Tracer tracer(world, {});
  const std::vector<LightGrid> grids = {MakeLightGrid(world.mover_meshes()[0], 0.08f)};
  const MoverLight light(world, grids, {});
  const Snapshot snapshot = world.At(0);
  const std::vector<float> lit =
      light.At(tracer.Pose(snapshot), 0, LightVolume(),
               std::vector<std::uint8_t>(grids[0].points.size(), 1), 0.004f);
  const std::vector<SurfacePoint> places = LocatePoints(
      grids[0], world.mover_meshes()[0], snapshot.movers[0].positions, snapshot.movers[0].normals);
  int met = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const float exact = UnshadowedIrradiance(world.lights()[0], places[i]);
    if (exact < 0.01f) continue;  // turned away, but for rounding
    ++met;
    EXPECT_NEAR(lit[i], exact, 0.03f * exact) << places[i].position.transpose();
  }
  EXPECT_GT(met, 50);
}

TEST(LightOnMovers, IsWhatManyShadowRaysFind) {
  const LitHall hall;
  const Snapshot snapshot = Swayed(hall.world, 0);
  const std::vector<float> light =
      hall.At(snapshot, std::vector<std::uint8_t>(hall.grids[0].points.size(), 1));
  const Instant instant = hall.tracer.Pose(snapshot);
  const std::vector<SurfacePoint> places =
      LocatePoints(hall.grids[0], hall.world.mover_meshes()[0], snapshot.movers[0].positions,
                   snapshot.movers[0].normals);
  double error = 0, sum = 0;
  for (std::size_t i = 0; i < places.size(); i += 13) {
    const float expected =
        GatherDirectLight(instant, hall.world.lights(), snapshot.light_scale,
                          std::span(places).subspan(i, 1), {.untraced_share = 0, .rays = 512})[0];
    error += std::abs(light[i] - expected);
    sum += expected;
  }
  EXPECT_LT(error / sum, 0.05);
}

}  // namespace
}  // namespace aisle::sim
