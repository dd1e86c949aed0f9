#include "simulator/shade/pass/beam_light.h"

#include <gtest/gtest.h>

#include <numbers>

#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

constexpr float kAlbedo = 0.5f;

/// A floor, a lamp that is off, and what each test adds; seen straight from above.
struct Floor {
  Floor() {
    parts.instances = {{"nothing", ObjectClass::kNone, false},
                       {"floor", ObjectClass::kFloor, false},
                       {"pane", ObjectClass::kFurniture, true}};
    parts.materials = {{.name = "floor", .albedo = kAlbedo},
                       {.name = "pane", .albedo = 0, .transmission = 0.8f}};
    parts.lights.push_back({{0, 0, 9}, {1, 0, 0}, {0, -1, 0}, 1});
    floor.Quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, 0, 1);
    parts.has_beams = true;
  }

  /// Radiance at the floor's point (x, y), the camera 4 m above it.
  float At(double x, double y) {
    WorldParts made = parts;
    made.statics = {floor.mesh, floor.instances};
    made.at = [beams = beams, movers = movers](std::int64_t stamp_ns) {
      Snapshot snapshot{.stamp_ns = stamp_ns, .movers = movers, .light_scale = {0}};
      snapshot.beams = beams;
      return snapshot;
    };
    const World world(std::move(made));
    const Tracer tracer(world, {});
    ShadeOptions options{.statics = {.texel_m = 1, .coarse_texel_m = 4, .volume_spacing_m = 4}};
    options.gloss = options.antialias = false;
    const Shader shader(world, tracer, options);
    const StereoCamera camera{.width = 8, .height = 8, .fx = 800, .fy = 800, .cx = 3.5, .cy = 3.5};
    const PixelRays rays = MakePixelRays(camera);
    Eigen::Isometry3d down = Eigen::Isometry3d::Identity();
    down.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    down.translation() << x, y, 4;
    const std::array view = {CameraView(rays, down)};
    const Instant instant = tracer.Pose(world.At(0));
    std::vector<HitImage> hits;
    TraceViews(instant, view, {}, &hits);
    return static_cast<float>(cv::mean(shader.Shade(instant, view, hits)[0])[0]);
  }

  /// A clear sheet over the floor.
  void AddPane() {
    test::MeshBuilder pane;
    pane.Quad({-2, -2, 1}, {4, 0, 0}, {0, 4, 0}, 1, 2);
    parts.mover_meshes = {pane.mesh};
    MoverState state;
    state.instance = 2;
    state.positions = pane.mesh.positions;
    state.normals = pane.mesh.normals;
    state.velocities.assign(state.positions.size(), Eigen::Vector3f::Zero());
    state.casts_shadow = false;
    movers = {state};
  }

  WorldParts parts;
  test::MeshBuilder floor;
  std::vector<Beam> beams;
  std::vector<MoverState> movers;
};

Beam Spot() {
  Beam beam;
  beam.origin = {0, 0, 3};
  beam.toward = -Eigen::Vector3f::UnitZ();
  beam.power = 2;
  beam.cos_inner = std::cos(0.5f), beam.cos_outer = std::cos(0.6f);
  return beam;
}

/// Lambert: radiance = albedo / pi · intensity · cos / r².
TEST(BeamLight, ASpotLightsBySquareAndCosine) {
  Floor floor;
  floor.beams = {Spot()};
  for (const double x : {0.0, 0.5, 1.2}) {
    const double squared = 9 + x * x;
    const double expected = kAlbedo / std::numbers::pi * 2 * 3 / (squared * std::sqrt(squared));
    EXPECT_NEAR(floor.At(x, 0), expected, 2e-3 * expected) << x;
  }
  EXPECT_EQ(floor.At(3, 0), 0) << "beyond its cone";
}

TEST(BeamLight, WhatStandsBetweenKeepsItAway) {
  Floor floor;
  floor.beams = {Spot()};
  floor.floor.Quad({0.4f, -0.2f, 1.5f}, {0.4f, 0, 0}, {0, 0.4f, 0}, 0, 1);
  EXPECT_EQ(floor.At(1.2, 0), 0) << "in the plate's shadow, which is twice as far off";
  EXPECT_GT(floor.At(0, 0), 0);
}

/// A patch of sun lies where lines along the sun's direction through the window end.
TEST(BeamLight, TheSunsPatchIsTheWindowsShadow) {
  Floor floor;
  Beam sun;
  sun.kind = Beam::Kind::kSun;
  sun.origin = {0, 0, 3};
  sun.toward = Eigen::Vector3f(-1, 0, 1).normalized();
  sun.power = 3;
  sun.half_u = {0.5f, 0, 0}, sun.half_v = {0, 0.4f, 0};
  floor.beams = {sun};
  // At 45 degrees the patch is 3 m on, from 2.5 to 3.5 and 0.4 to either side.
  const double inside = kAlbedo / std::numbers::pi * 3 * std::sqrt(0.5);
  for (const double x : {2.6, 3.0, 3.4}) EXPECT_NEAR(floor.At(x, 0), inside, 1e-4) << x;
  for (const double x : {2.4, 3.6, 0.0}) EXPECT_EQ(floor.At(x, 0), 0) << x;
  EXPECT_EQ(floor.At(3, 0.5), 0);
  // Two panes: their bar's shadow in the middle.
  floor.beams[0].columns = 2;
  floor.beams[0].bar_u = 0.2f;
  EXPECT_EQ(floor.At(3, 0), 0);
  EXPECT_NEAR(floor.At(2.75, 0), inside, 1e-4);
}

TEST(ClearPass, APaneLetsItsShareThroughAndThrowsNoShadow) {
  Floor open, covered;
  open.beams = covered.beams = {Spot()};
  covered.AddPane();
  EXPECT_NEAR(covered.At(0.5, 0), 0.8f * open.At(0.5, 0), 1e-3 * open.At(0.5, 0));
}

}  // namespace
}  // namespace aisle::sim
