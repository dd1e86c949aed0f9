#include "simulator/shade/surface/normal_map.h"

#include <gtest/gtest.h>

#include "simulator/shade/reference/reference.h"
#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

const Eigen::Vector3f kLamp(1.5f, 0.5f, 4);

/// A floor with u along x and v along y under one small lamp; its normal map, if any, is of one
/// colour.
WorldParts Floor(const Eigen::Vector3f* map) {
  WorldParts parts;
  parts.instances.push_back({"floor", ObjectClass::kFloor, false});
  parts.materials = {{.name = "floor", .albedo = 0.6f},
                     {.name = "lamp", .albedo = 0.5f, .emission = 50}};
  if (map) {
    const Eigen::Vector3f rgb = (*map + Eigen::Vector3f::Ones()) * 127.5f;
    parts.textures.push_back(
        {"bumps", cv::Mat3b(4, 4,
                            cv::Vec3b(cv::saturate_cast<std::uint8_t>(rgb.x()),
                                      cv::saturate_cast<std::uint8_t>(rgb.y()),
                                      cv::saturate_cast<std::uint8_t>(rgb.z())))});
    parts.materials[0].normal_texture = 0;
  }
  test::MeshBuilder mesh;
  mesh.Quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0, 1);
  const Eigen::Vector3f hu(0.1f, 0, 0), hv(0, -0.1f, 0);
  parts.lights.push_back({kLamp, hu, hv, 50});
  mesh.Quad(kLamp - hu - hv, 2 * hu, 2 * hv, 1, 1);
  parts.statics = {mesh.mesh, mesh.instances};
  return parts;
}

struct View {
  View() : rays(MakePixelRays(camera)), left(rays, test::LookAlong({-2, 0, 1}, 0)) {}

  StereoCamera camera{.width = 64, .height = 48, .fx = 40, .fy = 40, .cx = 31.5, .cy = 4};
  PixelRays rays;
  CameraView left;
};

cv::Mat1f Nightly(const World& world, const View& view) {
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose(world.At(0));
  std::vector<HitImage> hits;
  TraceViews(instant, {&view.left, 1}, {}, &hits);
  return Shader(world, tracer, {.statics = {}, .antialias = false})
      .Shade(instant, {&view.left, 1}, hits)[0];
}

cv::Mat1f Traced(const World& world, const View& view) {
  const Tracer tracer(world, {});
  const TexturePool textures(world.textures());
  return Reference(world, textures)
      .Render(tracer.Pose(world.At(0)), view.left, {.samples = 64, .depth = 2});
}

/// How much brighter a floor of that normal is than a level one, at a pixel.
float TiltGain(const View& view, int x, int y, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f ray = view.left.rotation * view.rays.At(x, y).homogeneous();
  const Eigen::Vector3f to_lamp = kLamp - (view.left.origin - view.left.origin.z() / ray.z() * ray);
  return to_lamp.dot(normal) / to_lamp.z();
}

/// The normal that a map of one colour makes at a scale, z along the surface's own.
Eigen::Vector3f NormalOf(const cv::Vec3b& rgb, float scale) {
  const std::vector<Texture> textures = {{"map", cv::Mat3b(4, 4, rgb)}};
  const Eigen::Vector2f bend = TexturePool(textures).SampleNormal({0, 0.3f, 0.4f, 0.1f});
  return BentNormal(
      {Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY(), {}}, bend,
      scale);
}

/// glTF 2.0: normalize((sample * 2 - 1) * (scale, scale, 1)).
TEST(BentNormal, IsTheNormalOfGltf) {
  for (const cv::Vec3b& rgb :
       {cv::Vec3b(128, 128, 255), cv::Vec3b(127, 127, 255), cv::Vec3b(204, 128, 230),
        cv::Vec3b(230, 128, 204), cv::Vec3b(60, 170, 227)}) {
    for (const float scale : {0.5f, 1.0f, 2.0f}) {
      const Eigen::Vector3f sample =
          Eigen::Vector3f(rgb[0], rgb[1], rgb[2]) / 127.5f - Eigen::Vector3f::Ones();
      const Eigen::Vector3f expected =
          sample.cwiseProduct(Eigen::Vector3f(scale, scale, 1)).normalized();
      const float cosine = NormalOf(rgb, scale).dot(expected);
      // The z of these is rounded to half a byte.
      EXPECT_LT(std::acos(std::min(1.0f, cosine)), 6e-3f) << rgb << ' ' << scale;
    }
  }
}

TEST(BentNormal, AFlatMapIsFlatToHalfAByte) {
  const float half = 1 / 255.0f;
  for (const int flat : {127, 128}) {
    const Eigen::Vector3f normal = NormalOf(
        cv::Vec3b(static_cast<std::uint8_t>(flat), static_cast<std::uint8_t>(flat), 255), 1);
    EXPECT_NEAR(std::abs(normal.x()), half, 1e-5);
    EXPECT_NEAR(std::abs(normal.y()), half, 1e-5);
  }
}

class NormalMap : public testing::TestWithParam<Eigen::Vector3f> {};

TEST_P(NormalMap, AFlatFloorShadesAsTheTiltedPlaneThatTheMapSays) {
  const View view;
  const Eigen::Vector3f map = GetParam().normalized();
  // The picture's x runs along u, which is world x; its y against v, which is world y.
  const Eigen::Vector3f tilted(map.x(), -map.y(), map.z());
  const World flat{Floor(nullptr)}, mapped{Floor(&map)};
  const cv::Mat1f nightly = Nightly(mapped, view), nightly_flat = Nightly(flat, view);
  const cv::Mat1f traced = Traced(mapped, view), traced_flat = Traced(flat, view);
  for (int y = 20; y < 48; y += 3) {
    for (int x = 2; x < 64; x += 5) {
      const float expected = TiltGain(view, x, y, tilted);
      EXPECT_NEAR(nightly(y, x) / nightly_flat(y, x), expected, 0.02f) << x << ' ' << y;
      EXPECT_NEAR(traced(y, x) / traced_flat(y, x), expected, 0.02f) << x << ' ' << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tilts, NormalMap,
                         testing::Values(Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0.3f, 0, 1),
                                         Eigen::Vector3f(0, 0.3f, 1),
                                         Eigen::Vector3f(-0.2f, -0.25f, 1)));

}  // namespace
}  // namespace aisle::sim
