#include "simulator/trace/tracer.h"

#include <gtest/gtest.h>

#include "simulator/camera/pixel_rays.h"
#include "simulator/trace/hit_image.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

WorldParts Empty() {
  WorldParts parts;
  parts.materials.resize(1);
  parts.lights.push_back({{0, 0, 5}, {1, 0, 0}, {0, -1, 0}, 1});
  parts.instances.push_back({"thing", ObjectClass::kFurniture, false});
  return parts;
}

HitImage TraceOne(const World& world, const Eigen::Isometry3d& pose, const StereoCamera& camera) {
  const Tracer tracer(world, {});
  const PixelRays rays = MakePixelRays(camera);
  std::vector<HitImage> images;
  const std::array views = {CameraView(rays, pose)};
  TraceViews(tracer.Pose(world.At(0)), views, {}, &images);
  return images[0];
}

TEST(TraceViews, DepthOfAFacingPlaneIsItsDistanceEverywhere) {
  WorldParts parts = Empty();
  test::MeshBuilder wall;
  wall.Quad({4, 50, -50}, {0, -100, 0}, {0, 0, 100}, 0, 1);
  parts.statics = {wall.mesh, wall.instances};
  const StereoCamera camera;
  const HitImage hits = TraceOne(World(std::move(parts)), test::LookAlong({0, 0, 0}, 0), camera);
  for (int y = 0; y < camera.height; y += 7) {
    for (int x = 0; x < camera.width; x += 7) EXPECT_NEAR(hits.t[hits.Index(x, y)], 4, 4e-6);
  }
}

TEST(TraceViews, SphereIsWhereGeometrySaysWithinItsFacets) {
  WorldParts parts = Empty();
  test::MeshBuilder ball;
  const float radius = 0.5f;
  const int rings = 200;
  ball.Sphere({3, 0, 0}, Eigen::Vector3f::Constant(radius), rings, 0, 1);
  parts.statics = {ball.mesh, ball.instances};
  const StereoCamera camera;
  const HitImage hits = TraceOne(World(std::move(parts)), test::LookAlong({0, 0, 0}, 0), camera);
  // A chord of the facet's angle lies this far inside the sphere.
  const double sagitta = radius * (1 - std::cos(M_PI / rings));
  int on_ball = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d d((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
      const double b = d.z() * 3, a = d.squaredNorm(), c = 9 - radius * radius;
      const double root = b * b - a * c;
      const float t = hits.t[hits.Index(x, y)];
      if (root < 0) {
        EXPECT_EQ(t, kInfinity);
      }
      if (root < 0.05) continue;  // near the outline a facet's sagitta moves the hit far
      ++on_ball;
      EXPECT_NEAR(t, (b - std::sqrt(root)) / a, 12 * sagitta);
    }
  }
  EXPECT_GT(on_ball, 10000);
}

TEST(TraceViews, TileOrderDoesNotMatter) {
  const World world(test::Hall({.boxes = 200}));
  const Tracer tracer(world, {});
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  const std::array views = {CameraView(rays, test::LookAlong({1, 0, 1}, 0))};
  const Instant instant = tracer.Pose(world.At(kSecond));
  std::vector<HitImage> a, b;
  TraceViews(instant, views, {}, &a);
  TraceViews(instant, views, {.shuffle = 99}, &b);
  EXPECT_EQ(a[0].t, b[0].t);
  EXPECT_EQ(a[0].primitive, b[0].primitive);
  EXPECT_EQ(a[0].u, b[0].u);
}

TEST(TraceViews, OddImageSizesAreWhole) {
  const World world(test::Hall({.boxes = 200}));
  StereoCamera odd;
  odd.width = 53;
  odd.height = 37;
  odd.cx = 26;
  odd.cy = 18;
  odd.fx = odd.fy = 30;
  const HitImage hits = TraceOne(world, test::LookAlong({1, 0, 1}, 0), odd);
  for (int y = 0; y < odd.height; ++y) {
    for (int x = 0; x < hits.stride; ++x) {
      EXPECT_EQ(hits.geometry[hits.Index(x, y)] == kNoGeometry, x >= odd.width);
    }
  }
}

TEST(Tracer, APoseGivesTheSameHitsWhateverWasPosedBefore) {
  const World world(test::Hall({.boxes = 200}));
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  const std::array views = {CameraView(rays, test::LookAlong({4, 0, 1}, 0))};
  const Tracer fresh(world, {}), used(world, {});
  for (int i = 9; i > 0; --i) used.Pose(world.At(i * kSecond));
  std::vector<HitImage> a, b;
  TraceViews(fresh.Pose(world.At(2 * kSecond)), views, {}, &a);
  TraceViews(used.Pose(world.At(2 * kSecond)), views, {}, &b);
  EXPECT_EQ(a[0].t, b[0].t);
  EXPECT_EQ(a[0].u, b[0].u);
}

TEST(Instant, OcclusionAgreesWithIntersection) {
  const World world(test::Hall({.boxes = 200}));
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose(world.At(kSecond));
  cv::RNG rng(3);
  for (int i = 0; i < 200; ++i) {
    Rays8 rays;
    for (int k = 0; k < kLanes; ++k) {
      rays.ox[k] = rng.uniform(1.0f, 28.0f);
      rays.oy[k] = rng.uniform(-1.0f, 1.0f);
      rays.oz[k] = rng.uniform(0.2f, 2.0f);
      rays.dx[k] = rng.uniform(-1.0f, 1.0f);
      rays.dy[k] = rng.uniform(-1.0f, 1.0f);
      rays.dz[k] = rng.uniform(-1.0f, 1.0f);
      rays.t_near[k] = 0;
      rays.t_far[k] = rng.uniform(0.1f, 6.0f);
      rays.valid[k] = rng.uniform(0, 4) ? -1 : 0;
    }
    for (const GeometryMask mask : {kEverything, kStaticOnly, kMoversOnly}) {
      Hits8 hits;
      instant.Intersect(rays, Coherence::kIncoherent, mask, &hits);
      const unsigned occluded = instant.Occluded(rays, Coherence::kIncoherent, mask);
      for (int k = 0; k < kLanes; ++k) {
        EXPECT_EQ(hits.geometry[k] != kNoGeometry, (occluded >> k & 1) != 0);
      }
    }
  }
}

}  // namespace
}  // namespace aisle::sim
