#include "simulator/shade/reference/reference.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "simulator/foreign/foreign_scene.h"
#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"
#include "tests/support/test_data.h"

namespace aisle::sim {
namespace {

/// A closed cube of half side 1 whose walls all shine with `emission` and reflect `albedo`. In it
/// the radiance is emission · (1 + albedo + albedo² + …) everywhere, whatever the shape.
WorldParts Furnace(float albedo, float emission) {
  WorldParts parts;
  parts.instances.push_back({"walls", ObjectClass::kLuminaire, false});
  parts.materials.push_back({.name = "wall", .albedo = albedo, .emission = emission});
  test::MeshBuilder walls;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      Eigen::Vector3f u = Eigen::Vector3f::Zero(), v = Eigen::Vector3f::Zero();
      Eigen::Vector3f center = Eigen::Vector3f::Zero();
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = 1;
      center[axis] = side;
      if (side > 0) std::swap(u, v);  // u × v looks inwards
      walls.Quad(center - u - v, 2 * u, 2 * v, 0, 1);
      parts.lights.push_back({center, u, v, emission});
    }
  }
  parts.statics = {walls.mesh, walls.instances};
  return parts;
}

StereoCamera SmallCamera(int size, double focal) {
  return {.width = size,
          .height = size,
          .fx = focal,
          .fy = focal,
          .cx = (size - 1) / 2.0,
          .cy = (size - 1) / 2.0};
}

cv::Mat1f Trace(const World& world, const Eigen::Isometry3d& pose, const StereoCamera& camera,
                const ReferenceOptions& options) {
  const Tracer tracer(world, {});
  const TexturePool textures(world.textures());
  const PixelRays rays = MakePixelRays(camera);
  return Reference(world, textures)
      .Render(tracer.Pose(world.At(0)), CameraView(rays, pose), options);
}

TEST(Reference, FurnaceShowsTheGeometricSeries) {
  const float albedo = 0.5f, emission = 1;
  for (const int depth : {1, 2, 4, 12}) {
    const cv::Mat1f image =
        Trace(World(Furnace(albedo, emission)), test::LookAlong({0.1, -0.2, 0.15}, 0.4),
              SmallCamera(48, 30), {.samples = 128, .depth = depth});
    const double expected = emission * (1 - std::pow(albedo, depth)) / (1 - albedo);
    EXPECT_NEAR(cv::mean(image)[0], expected, 1e-3 * expected) << "depth " << depth;
  }
}

TEST(Reference, FurnaceOfBrightWallsConvergesToItsClosedForm) {
  const cv::Mat1f image = Trace(World(Furnace(0.8f, 0.2f)), test::LookAlong({0.1, -0.2, 0.15}, 0.4),
                                SmallCamera(32, 20), {.samples = 128, .depth = 48});
  EXPECT_NEAR(cv::mean(image)[0], 0.2 / (1 - 0.8), 1e-3);
}

TEST(Reference, ABallOfFewFacetsIsShadedAsABall) {
  // A small lamp far to the side, so that the border of its light falls within facets, not along
  // their edges. On the true ball the irradiance goes with the cosine to it; the part of a facet
  // whose own plane faces away while its normals do not would be black.
  constexpr float kRadius = 0.5f, kDistance = 50, kHalf = 0.5f, kRadiance = 10'000, kAlbedo = 0.5f;
  const Eigen::Vector3f center(2, 0, 0), across(std::cos(0.2f), std::sin(0.2f), 0);
  const Eigen::Vector3f to_lamp = Eigen::Vector3f::UnitZ().cross(across);
  WorldParts parts;
  parts.instances.push_back({"ball", ObjectClass::kGoods, false});
  parts.materials.push_back({.name = "ball", .albedo = kAlbedo});
  test::MeshBuilder ball;
  ball.Sphere(center, Eigen::Vector3f::Constant(kRadius), 8, 0, 1);
  parts.statics = {ball.mesh, ball.instances};
  parts.lights.push_back(
      {center + kDistance * to_lamp, kHalf * across, kHalf * Eigen::Vector3f::UnitZ(), kRadiance});
  const StereoCamera camera = SmallCamera(96, 160);
  const cv::Mat1f image = Trace(World(std::move(parts)), test::LookAlong({0, 0, 0}, 0), camera,
                                {.samples = 64, .depth = 2});

  const float frontal =
      kAlbedo * kRadiance * 4 * kHalf * kHalf / std::numbers::pi_v<float> / (kDistance * kDistance);
  int grazed = 0, black = 0, off = 0, lit_behind = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const Eigen::Vector3f ray =
          Eigen::Vector3f(1, -static_cast<float>((x - camera.cx) / camera.fx),
                          -static_cast<float>((y - camera.cy) / camera.fy))
              .normalized();
      const float along = ray.dot(center);
      const float inside = 0.9f * kRadius * kRadius - center.squaredNorm() + along * along;
      if (inside < 0) continue;  // off the ball, or at its outline
      const float t = along - std::sqrt(inside + 0.1f * kRadius * kRadius);
      const float cosine = (t * ray - center).dot(to_lamp) / kRadius;
      if (cosine > 0.04f && cosine < 0.15f) {
        ++grazed;
        black += image(y, x) < 0.2f * frontal * cosine;
        off += std::abs(image(y, x) - frontal * cosine) > 0.03f * frontal;
      }
      lit_behind += cosine < -0.1f && image(y, x) > 0;
    }
  }
  ASSERT_GT(grazed, 200);
  EXPECT_LE(black, 0.02 * grazed);
  EXPECT_LE(off, 0.02 * grazed);
  EXPECT_EQ(lit_behind, 0);
}

/// The mean of a view by the production light.
double MeanOfProduction(const World& world, const Eigen::Isometry3d& pose,
                        const StereoCamera& camera, const ShadeOptions& options) {
  const Tracer tracer(world, {});
  const PixelRays rays = MakePixelRays(camera);
  const std::array views = {CameraView(rays, pose)};
  const Instant instant = tracer.Pose(world.At(0));
  std::vector<HitImage> hits;
  TraceViews(instant, views, {}, &hits);
  return cv::mean(Shader(world, tracer, options).Shade(instant, views, hits)[0])[0];
}

TEST(ProductionLight, LuminairesReflectBesideWhatTheyEmit) {
  // Seen: e + albedo · E / π with E / π = e · (1 + albedo + … ) of seven surfaces, by the direct
  // light and six bounces.
  const float albedo = 0.5f, emission = 1;
  const double expected = emission * (1 - std::pow(albedo, 8)) / (1 - albedo);
  const ShadeOptions options{.statics = {.coarse_texel_m = 0.2f, .directions = 256}};
  EXPECT_NEAR(
      MeanOfProduction(World(Furnace(albedo, emission)), test::LookAlong({0.1, -0.2, 0.15}, 0.4),
                       SmallCamera(48, 30), options),
      expected, 0.02 * expected);
}

TEST(ProductionLight, ADimLampUnderABrightOneIsThatOfTheReference) {
  WorldParts parts = Furnace(0.6f, 0.05f);
  parts.materials.push_back({.name = "bright", .albedo = 0.3f, .emission = 2});
  parts.statics.mesh.materials[10] = parts.statics.mesh.materials[11] = 1;  // the ceiling
  parts.lights[5].radiance = 2;
  const World world(std::move(parts));
  Eigen::Isometry3d down = Eigen::Isometry3d::Identity();
  down.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const StereoCamera camera = SmallCamera(32, 40);
  const double reference = cv::mean(Trace(world, down, camera, {.samples = 256, .depth = 16}))[0];
  ASSERT_GT(reference, 0.3);  // far more than it emits
  const ShadeOptions options{.statics = {.coarse_texel_m = 0.2f, .directions = 256, .bounces = 12}};
  EXPECT_NEAR(MeanOfProduction(world, down, camera, options), reference, 0.02 * reference);
}

TEST(ProductionLight, WhatAGlossyFloorMirrorsReachesTheWalls) {
  WorldParts parts = Furnace(0.5f, 1);
  parts.materials.push_back({.name = "wall", .albedo = 0.5f});
  parts.materials.push_back(
      {.name = "polished", .albedo = 0.1f, .specular_f0 = 0.3f, .roughness = 0.35f});
  for (std::size_t i = 0; i < 8; ++i) parts.statics.mesh.materials[i] = 1;
  parts.statics.mesh.materials[8] = parts.statics.mesh.materials[9] = 2;  // the ceiling shines
  parts.lights = {parts.lights[5]};
  const World world(std::move(parts));
  const Eigen::Isometry3d pose = test::LookAlong({-0.5, 0, 0}, 0);
  const StereoCamera camera = SmallCamera(24, 24);  // only the wall ahead
  const double reference = cv::mean(Trace(world, pose, camera, {.samples = 1024, .depth = 12}))[0];
  const ShadeOptions options{.statics = {.coarse_texel_m = 0.2f, .directions = 256, .bounces = 11}};
  EXPECT_NEAR(MeanOfProduction(world, pose, camera, options), reference, 0.04 * reference);
}

TEST(Reference, CornellBoxIsThatOfAnotherRendererBlockByBlock) {
  const std::filesystem::path folder = TestData("cornell");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);
  const cv::Mat exr = cv::imread((folder / "ref-cbox-d6-4096.exr").string(),
                                 cv::IMREAD_UNCHANGED | cv::IMREAD_ANYDEPTH);
  ASSERT_FALSE(exr.empty());
  std::vector<cv::Mat> bands;
  cv::split(exr, bands);  // B, G, R

  ForeignScene scene = LoadForeignScene(folder / "cbox-base.json");
  for (int band = 0; band < 3; ++band) {
    // A path of depth 6 has six edges, the first from the camera: it touches six surfaces. Blue is
    // the darkest, so its blocks need more paths.
    const World world(std::move(scene.bands[static_cast<std::size_t>(band)]));
    const cv::Mat1f image = Trace(world, scene.T_world_camera, scene.camera,
                                  {.samples = band == 2 ? 256 : 128, .depth = 6});
    const cv::Mat1f expected = bands[static_cast<std::size_t>(2 - band)];
    if (const char* pictures = std::getenv("AISLE_TEST_PICTURES")) {
      cv::imwrite(fmt::format("{}/cornell_{}.png", pictures, band), image * 255 / 2);
      cv::imwrite(fmt::format("{}/cornell_ref_{}.png", pictures, band), expected * 255 / 2);
    }
    EXPECT_NEAR(cv::mean(image)[0], cv::mean(expected)[0], 0.003 * cv::mean(expected)[0])
        << "band " << band;
    cv::Mat1f ours, theirs;
    cv::resize(image, ours, {32, 32}, 0, 0, cv::INTER_AREA);
    cv::resize(expected, theirs, {32, 32}, 0, 0, cv::INTER_AREA);
    int close = 0;  // blocks of 8 × 8 pixels within 3 %
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        close += std::abs(ours(y, x) - theirs(y, x)) <= 0.03f * std::max(theirs(y, x), 1e-3f);
      }
    }
    EXPECT_GE(close, 0.95 * 1024) << "band " << band;
  }
}

TEST(NightlyLight, AgreesWithTheReferenceInAHallWithMovers) {
  const World world(test::Hall({.boxes = 120, .lights = 8}));
  const Tracer tracer(world, {});
  const TexturePool textures(world.textures());
  StereoCamera camera;
  camera.width = 188;
  camera.height = 120;
  camera.fx = camera.fy = 108.8;
  camera.cx = 91.4;
  camera.cy = 62.7;
  const PixelRays rays = MakePixelRays(camera);
  const std::array views = {CameraView(rays, test::LookAlong({2, 0, 1.4}, 0.05))};
  const Instant instant = tracer.Pose(world.At(2'000'000'000));
  std::vector<HitImage> hits;
  TraceViews(instant, views, {}, &hits);
  const Shader shader(world, tracer, {.statics = {.directions = 128}});
  const cv::Mat1f nightly = shader.Shade(instant, views, hits)[0];
  const cv::Mat1f reference =
      Reference(world, textures).Render(instant, views[0], {.samples = 64, .depth = 8});
  if (const char* pictures = std::getenv("AISLE_TEST_PICTURES")) {
    cv::imwrite(fmt::format("{}/nightly.png", pictures), nightly * 2000);
    cv::imwrite(fmt::format("{}/reference.png", pictures), reference * 2000);
  }
  // Means over 4 × 4 pixels: the reference's own noise is not what is tested.
  cv::Mat1f ours, theirs;
  cv::resize(nightly, ours, {}, 0.25, 0.25, cv::INTER_AREA);
  cv::resize(reference, theirs, {}, 0.25, 0.25, cv::INTER_AREA);
  std::vector<float> errors;
  for (int y = 0; y < theirs.rows; ++y) {
    for (int x = 0; x < theirs.cols; ++x) {
      errors.push_back(std::abs(ours(y, x) / std::max(theirs(y, x), 1e-6f) - 1));
    }
  }
  std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2));
  EXPECT_LE(errors[errors.size() / 2], 0.05f);
}

}  // namespace
}  // namespace aisle::sim
