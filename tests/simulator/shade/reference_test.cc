#include "simulator/shade/reference.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

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
  return Reference(world, textures).Render(tracer.Pose(world.At(0)), EyeView(rays, pose), options);
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

/// The mean of a view by the production light.
double MeanOfProduction(const World& world, const Eigen::Isometry3d& pose,
                        const StereoCamera& camera, const ShadeOptions& options) {
  const Tracer tracer(world, {});
  const PixelRays rays = MakePixelRays(camera);
  const std::array views = {EyeView(rays, pose)};
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

/// The vertices and faces of an OBJ file that holds nothing else.
void AddObj(const std::filesystem::path& file, const Eigen::Vector3f& shift, std::uint16_t material,
            test::MeshBuilder* world) {
  std::ifstream in(file);
  ASSERT_TRUE(in) << file;
  std::vector<Eigen::Vector3f> vertices;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Eigen::Vector3f v;
      words >> v.x() >> v.y() >> v.z();
      vertices.push_back((v + shift) / 100);  // in decimetres: shadow rays' margins are metric
    } else if (kind == "f") {
      std::vector<std::size_t> corners;
      std::string corner;
      while (words >> corner) {
        const int index = std::stoi(corner);
        corners.push_back(index > 0 ? static_cast<std::size_t>(index - 1)
                                    : vertices.size() - static_cast<std::size_t>(-index));
      }
      for (std::size_t i = 2; i < corners.size(); ++i) {
        const Eigen::Vector3f a = vertices[corners[0]], b = vertices[corners[i - 1]],
                              c = vertices[corners[i]];
        const Eigen::Vector3f n = (b - a).cross(c - a).normalized();
        const auto first = static_cast<std::uint32_t>(world->mesh.positions.size());
        for (const Eigen::Vector3f& p : {a, b, c}) {
          world->mesh.positions.push_back(p);
          world->mesh.normals.push_back(n);
          world->mesh.uvs.emplace_back(0, 0);
        }
        world->mesh.triangles.push_back({first, first + 1, first + 2});
        world->mesh.materials.push_back(material);
        world->instances.push_back(1);
      }
    }
  }
}

/// One band of the Cornell box.
WorldParts CornellBox(const std::filesystem::path& folder, int band) {
  constexpr std::array<std::array<float, 3>, 6> kAlbedo = {{{0.45f, 0.3f, 0.9f},
                                                            {0.885809f, 0.698859f, 0.666422f},
                                                            {0.570068f, 0.0430135f, 0.0443706f},
                                                            {0.105421f, 0.37798f, 0.076425f},
                                                            {0.936461f, 0.740433f, 0.705267f}}};
  constexpr std::array<float, 3> kRadiance = {18.387f, 10.9873f, 2.75357f};
  const auto b = static_cast<std::size_t>(band);
  WorldParts parts;
  parts.instances.push_back({"box", ObjectClass::kWall, false});
  for (std::size_t i = 0; i < 5; ++i)
    parts.materials.push_back({.name = "wall", .albedo = kAlbedo[i][b]});
  parts.materials[4].emission = kRadiance[b];
  const std::array<std::pair<const char*, std::uint16_t>, 8> shapes = {{{"luminaire", 4},
                                                                        {"floor", 1},
                                                                        {"ceiling", 1},
                                                                        {"back", 1},
                                                                        {"greenwall", 3},
                                                                        {"redwall", 2},
                                                                        {"smallbox", 0},
                                                                        {"largebox", 0}}};
  test::MeshBuilder world;
  for (const auto& [name, material] : shapes) {
    const Eigen::Vector3f shift(0, material == 4 ? -0.5f : 0.0f, 0);
    AddObj(folder / "meshes" / fmt::format("cbox_{}.obj", name), shift, material, &world);
  }
  // The luminaire's rectangle, looking down (-y).
  parts.lights.push_back({{2.78f, 5.483f, 2.795f}, {0.65f, 0, 0}, {0, 0, 0.525f}, kRadiance[b]});
  parts.statics = {world.mesh, world.instances};
  return parts;
}

TEST(Reference, CornellBoxIsThatOfAnotherRendererBlockByBlock) {
  const std::filesystem::path folder = std::filesystem::path(AISLE_TEST_DATA) / "cornell";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);
  const cv::Mat exr = cv::imread((folder / "ref-cbox-d6-4096.exr").string(),
                                 cv::IMREAD_UNCHANGED | cv::IMREAD_ANYDEPTH);
  ASSERT_FALSE(exr.empty());
  std::vector<cv::Mat> bands;
  cv::split(exr, bands);  // B, G, R

  const double focal = 128 / std::tan(39.3077 / 2 * M_PI / 180);
  const StereoCamera camera = SmallCamera(256, focal);
  // The camera looks along +z with y up and, seen along +z, +x to the left.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = -Eigen::Vector3d::UnitX();
  pose.linear().col(1) = -Eigen::Vector3d::UnitY();
  pose.linear().col(2) = Eigen::Vector3d::UnitZ();
  pose.translation() = Eigen::Vector3d(2.78, 2.73, -8);
  for (int band = 0; band < 3; ++band) {
    // A path of depth 6 has six edges, the first from the eye: it touches six surfaces. Blue is the
    // darkest, so its blocks need more paths.
    const cv::Mat1f image = Trace(World(CornellBox(folder, band)), pose, camera,
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
  const std::array views = {EyeView(rays, test::LookAlong({2, 0, 1.4}, 0.05))};
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
