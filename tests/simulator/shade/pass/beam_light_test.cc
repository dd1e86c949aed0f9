#include "simulator/shade/pass/beam_light.h"

#include <gtest/gtest.h>

#include <numbers>

#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

constexpr float kAlbedo = 0.5f;
constexpr float kGlow = 3;
constexpr std::uint16_t kFloor = 0, kPane = 1, kLens = 2, kMirror = 3, kGlossy = 4, kBar = 5,
                        kStripe = 6;  // materials

/// A floor, a lamp that may shine, and what each test adds; seen straight from above.
struct Floor {
  Floor() {
    parts.instances = {{"nothing", ObjectClass::kNone, false},
                       {"floor", ObjectClass::kFloor, false},
                       {"pane", ObjectClass::kFurniture, true}};
    parts.materials = {{.name = "floor", .albedo = kAlbedo},
                       {.name = "pane", .albedo = 0, .transmission = 0.8f},
                       {.name = "lens", .albedo = 0, .emission = kGlow},
                       {.name = "mirror", .albedo = 0, .specular_f0 = 0.9f, .roughness = 0.05f},
                       {.name = "glossy", .albedo = 0.1f, .specular_f0 = 0.1f, .roughness = 0.3f},
                       {.name = "bar", .albedo = 0.1f},
                       {.name = "stripe", .albedo = 1}};
    parts.lights.push_back({{0, 0, 9}, {1, 0, 0}, {0, -1, 0}, 1});
    floor.Quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}, 0, 1);
    parts.has_beams = true;
  }

  /// Radiance at the floor's point (x, y), the camera 4 m above it.
  float At(double x, double y) {
    WorldParts made = parts;
    made.statics = {floor.mesh, floor.instances};
    made.at = [beams = beams, movers = movers, lamp = lamp](std::int64_t stamp_ns) {
      Snapshot snapshot{.stamp_ns = stamp_ns, .movers = movers, .light_scale = {lamp}};
      snapshot.beams = beams;
      return snapshot;
    };
    const World world(std::move(made));
    const Tracer tracer(world, {});
    ShadeOptions options{.statics = {.texel_m = 1, .coarse_texel_m = 4, .volume_spacing_m = 4}};
    options.gloss = gloss;
    options.antialias = antialias;
    options.mover_shadows = mover_shadows;
    const Shader shader(world, tracer, options);
    const StereoCamera camera{
        .width = 8, .height = 8, .fx = focal_px, .fy = focal_px, .cx = 3.5, .cy = 3.5};
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

  /// A sheet of 4 × 4 m over the floor that moves; one that is clear casts no shadow.
  void AddSheet(float height_m, std::uint16_t material, float x = 0) {
    test::MeshBuilder sheet;
    sheet.Quad({x - 2, -2, height_m}, {4, 0, 0}, {0, 4, 0}, material, 2);
    parts.mover_meshes.push_back(sheet.mesh);
    MoverState state;
    state.instance = 2;
    state.positions = sheet.mesh.positions;
    state.normals = sheet.mesh.normals;
    state.velocities.assign(state.positions.size(), Eigen::Vector3f::Zero());
    state.casts_shadow = material != kPane;
    movers.push_back(state);
  }

  WorldParts parts;
  bool gloss = false, antialias = false, mover_shadows = true;
  float lamp = 0;  ///< how bright it is
  double focal_px = 800;
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

TEST(BeamLight, AFloorIsLitWhereItIsSeenWhicheverWayItIsWound) {
  Floor floor, turned_over;
  turned_over.floor = {};
  turned_over.floor.Quad({-10, -10, 0}, {0, 20, 0}, {20, 0, 0}, 0, 1);
  floor.beams = turned_over.beams = {Spot()};
  EXPECT_GT(floor.At(0.5, 0), 0);
  EXPECT_NEAR(turned_over.At(0.5, 0), floor.At(0.5, 0), 1e-6);
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
  covered.AddSheet(1, kPane);
  EXPECT_NEAR(covered.At(0.5, 0), 0.8f * open.At(0.5, 0), 1e-3 * open.At(0.5, 0));
}

/// The lamp is 2 × 2 m, 9 m up; of a sheet at 6 m that ends at x = 2 the half-shadow is from 4
/// to 8.
TEST(ClearPass, AMoversShadowIsThereBehindAPaneToo) {
  Floor bright, open, covered;
  bright.lamp = open.lamp = covered.lamp = 1;
  bright.mover_shadows = false;
  for (Floor* floor : {&bright, &open, &covered}) floor->AddSheet(6, kFloor);
  covered.AddSheet(1, kPane);
  covered.AddSheet(1, kPane, 6);
  const float lit = bright.At(0, 0);
  ASSERT_GT(lit, 1e-3f);
  EXPECT_LT(open.At(0, 0), 0.05f * lit);
  EXPECT_LT(covered.At(0, 0), 0.05f * lit);
  for (const double x : {4.5, 6.0, 7.5}) {
    const float through = 0.8f * open.At(x, 0);
    EXPECT_GT(through, 0.01f * lit) << x;
    EXPECT_NEAR(covered.At(x, 0), through, 0.03f * lit) << x;
  }
}

/// A bar in the middle of one column of pixels, and beside it a stripe that no pixel's centre
/// shows: what antialiasing finds of it is looked up. The lamp is hidden by a sheet, the beam is
/// not.
TEST(BeamLight, ALampsShadowTakesNothingFromItAtEdges) {
  Floor dark, shadowed;
  for (Floor* floor : {&dark, &shadowed}) {
    constexpr float kPixel = 0.005f;  // m on the floor
    floor->antialias = true;
    floor->beams = {Spot()};
    floor->AddSheet(6, kFloor);
    floor->floor.Quad({0, -1, 0.01f}, {0.75f * kPixel, 0, 0}, {0, 2, 0}, kBar, 1);
    floor->floor.Quad({0.75f * kPixel, -1, 0.01f}, {0.25f * kPixel, 0, 0}, {0, 2, 0}, kStripe, 1);
  }
  shadowed.lamp = 0.1f;
  Floor hard = dark;
  hard.antialias = false;
  const float expected = dark.At(0, 0);
  EXPECT_GT(expected, 1.04f * hard.At(0, 0)) << "the stripe is found";
  EXPECT_NEAR(shadowed.At(0, 0), expected, 2e-3f * expected);
}

/// By itself, whether or not anything in the scene is a beam.
TEST(Glow, AMoversLensIsAsBrightAsItShines) {
  for (const bool has_beams : {false, true}) {
    Floor floor;
    floor.parts.has_beams = has_beams;
    floor.AddSheet(0.5f, kLens);
    EXPECT_NEAR(floor.At(0, 0), kGlow, 1e-4);
    EXPECT_EQ(floor.At(5, 0), 0) << "beside it";
    floor.AddSheet(1, kPane);
    EXPECT_NEAR(floor.At(0, 0), 0.8 * kGlow, 1e-3) << "through a clear pane";
  }
}

TEST(Glow, AMirrorShowsIt) {
  for (const bool has_beams : {false, true}) {
    Floor floor;
    floor.parts.has_beams = has_beams;
    floor.gloss = true;
    floor.floor.Quad({-1, -1, 0.1f}, {2, 0, 0}, {0, 2, 0}, kMirror, 1);
    floor.AddSheet(6, kLens);  // above the camera
    EXPECT_NEAR(floor.At(0, 0), 0.9 * kGlow, 0.03 * kGlow);
  }
}

TEST(Glow, AMirrorShowsItThroughAPaneToo) {
  Floor floor;
  floor.gloss = true;
  floor.floor.Quad({-1, -1, 0.1f}, {2, 0, 0}, {0, 2, 0}, kMirror, 1);
  floor.AddSheet(6, kLens);
  floor.AddSheet(5, kPane);
  EXPECT_NEAR(floor.At(0, 0), 0.9 * kGlow, 0.03 * kGlow);
}

/// A lamp that a broad lobe mirrors shines through a pane, as its light on the floor does.
TEST(LobeLamps, APaneHidesNoLamp) {
  Floor open, covered, sheltered;
  for (Floor* floor : {&open, &covered, &sheltered}) {
    floor->gloss = true;
    floor->lamp = 1;
    floor->floor.Quad({-1, -1, 0.1f}, {2, 0, 0}, {0, 2, 0}, kGlossy, 1);
  }
  covered.AddSheet(6, kPane);
  sheltered.AddSheet(6, kFloor);
  const float lit = open.At(0.3, 0);
  ASSERT_GT(lit, 0);
  EXPECT_EQ(covered.At(0.3, 0), lit);
  EXPECT_LT(sheltered.At(0.3, 0), 0.5f * lit) << "a solid sheet does";
}

/// The sun is as broad at a bay's border as at the window's, and where no bar is it shows whole.
TEST(BeamLight, ABorderIsBlurredByTheBreadthOfTheSun) {
  Floor floor;
  Beam sun;
  sun.kind = Beam::Kind::kSun;
  sun.origin = {0, 0, 3};
  sun.toward = {0, 0, 1};
  sun.power = 1;
  sun.half_u = {1.2f, 0, 0}, sun.half_v = {0, 5, 0};
  sun.columns = 3;
  floor.focal_px = 40000;            // looks at less than a millimetre
  const float soft = 3 * 0.004654f;  // m, half the sun's breadth on the floor
  const float whole = kAlbedo * std::numbers::inv_pi_v<float>;
  for (const float bar_m : {0.0f, 0.06f}) {
    sun.bar_u = bar_m / 0.8f;
    floor.beams = {sun};
    // Share of [x - soft, x + soft] that is open.
    const auto seen = [&](float x) {
      float open = 0;
      for (int bay = 0; bay < 3; ++bay) {
        const float low = -1.2f + 0.8f * static_cast<float>(bay) + bar_m / 2;
        open += std::max(0.0f, std::min(low + 0.8f - bar_m, x + soft) - std::max(low, x - soft));
      }
      return open / (2 * soft);
    };
    for (const float x : {0.0f, 0.37f, 0.4f, 0.43f, 1.16f, 1.18f, 1.19f, 1.2f, 1.21f, 1.23f}) {
      EXPECT_NEAR(floor.At(x, 0) / whole, seen(x), 0.02) << x << ", bar " << bar_m;
    }
  }
}

}  // namespace
}  // namespace aisle::sim
