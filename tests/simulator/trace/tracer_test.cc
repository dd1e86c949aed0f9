#include "simulator/trace/tracer.h"

#include <gtest/gtest.h>

#include "simulator/camera/pixel_rays.h"
#include "simulator/trace/hit_image.h"
#include "simulator/trace/mover_windows.h"
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

/// A figure and a truck in the hall as seen from afar, close by, from within and aside, straight
/// and through lenses: the pixels in the corners of the widest are twenty times those in the
/// middle.
std::vector<StereoCamera> Cameras() {
  const StereoCamera straight = Coarser(StereoCamera{}, 4);
  StereoCamera bent = straight;
  bent.lens = {LensModel::kRadialTangential, {-0.28, 0.07, 0.0002, 0.00002}};
  StereoCamera wide = straight;
  wide.fx = wide.fy = 330.0 / 4;
  wide.lens = {LensModel::kEquidistant, {0, 0, 0, 0}};
  return {straight, bent, wide};
}

std::vector<Eigen::Isometry3d> PlacesAround(const Instant& instant) {
  std::vector<Eigen::Isometry3d> places;
  for (const Eigen::AlignedBox3f& box : instant.mover_boxes()) {
    const Eigen::Vector3d middle = box.center().cast<double>();
    for (const double away : {4.0, 0.9, 0.0, -0.2}) {
      places.push_back(test::LookAlong(middle - Eigen::Vector3d(away, 0.1, 0), 0.2));
    }
    for (const double aside : {0.8, 0.95, 1.1}) {
      places.push_back(test::LookAlong(middle - Eigen::Vector3d(4, 0.1, 0), aside));
    }
  }
  return places;
}

TEST(TraceViews, MeetsWhatRaysMeetThatAskForEverything) {
  const World world(test::Hall({.boxes = 200}));
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose(world.At(kSecond));
  int on_movers = 0;
  for (const StereoCamera& camera : Cameras()) {
    const PixelRays rays = MakePixelRays(camera);
    for (const Eigen::Isometry3d& place : PlacesAround(instant)) {
      const std::array views = {CameraView(rays, place)};
      std::vector<HitImage> together, alone;
      TraceViews(instant, views, {}, &together);
      TraceViews(instant, views, {.single_packets = true}, &alone);
      EXPECT_EQ(together[0].geometry, alone[0].geometry);
      EXPECT_EQ(together[0].primitive, alone[0].primitive);
      EXPECT_EQ(together[0].t, alone[0].t);
      for (int y = 0; y < camera.height; y += 2) {
        for (int x = 0; x < camera.width; x += 4) {
          Hits8 hits;
          instant.Intersect(PixelPacket(views[0], x, y), Coherence::kCoherent, kEverything, &hits);
          for (int k = 0; k < kLanes; ++k) {
            const std::size_t i = together[0].Index(x + k % 4, y + k / 4);
            ASSERT_EQ(together[0].geometry[i], hits.geometry[k]) << x << ", " << y;
            ASSERT_EQ(together[0].primitive[i], hits.primitive[k]);
            on_movers += hits.geometry[k] != 0 && hits.geometry[k] != kNoGeometry;
          }
        }
      }
    }
  }
  EXPECT_GT(on_movers, 10000);
}

TEST(MoverWindows, HoldEveryRayOfAPixelThatMeetsAMover) {
  const World world(test::Hall({.boxes = 200}));
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose(world.At(kSecond));
  cv::RNG rng(5);
  int on_movers = 0, spared = 0;
  for (const StereoCamera& camera : Cameras()) {
    const PixelRays rays = MakePixelRays(camera);
    for (const Eigen::Isometry3d& place : PlacesAround(instant)) {
      const CameraView view(rays, place);
      const MoverWindows windows(instant, view);
      for (int i = 0; i < 4000; ++i) {
        const int x = rng.uniform(0, camera.width), y = rng.uniform(0, camera.height);
        const GeometryMask may = windows.In(x, y, x + 1, y + 1);
        const PixelRays::Step step = rays.StepAt(x, y);
        Rays8 packet = PixelPacket(view, x, y);
        for (int k = 0; k < kLanes; ++k) {
          const Eigen::Vector2f ray = rays.At(x, y) + rng.uniform(-0.5f, 0.5f) * step.right +
                                      rng.uniform(-0.5f, 0.5f) * step.down;
          const Eigen::Vector3f way = view.rotation * ray.homogeneous();
          packet.dx[k] = way.x();
          packet.dy[k] = way.y();
          packet.dz[k] = way.z();
          packet.valid[k] = -1;
        }
        Hits8 hits;
        instant.Intersect(packet, Coherence::kCoherent, kMoversOnly, &hits);
        spared += may == kStaticOnly;
        for (int k = 0; k < kLanes; ++k) {
          if (hits.geometry[k] == kNoGeometry) continue;
          ++on_movers;
          ASSERT_TRUE(may & MoverBit(hits.geometry[k] - 1)) << x << ", " << y;
        }
      }
    }
  }
  EXPECT_GT(on_movers, 10000);
  EXPECT_GT(spared, 10000);
}

TEST(Instant, MeetsATriangleThatIsAskedForWhateverStandsBeforeIt) {
  const World world(test::Hall({.boxes = 200, .movers = false}));
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose(world.At(kSecond));
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  const CameraView view(rays, test::LookAlong({1, 0, 1}, 0));
  int met = 0, passed = 0;
  for (int y = 0; y < camera.height; y += 20) {
    for (int x = 0; x + 4 < camera.width; x += 20) {
      const Rays8 packet = PixelPacket(view, x, y);
      Hits8 hits;
      instant.Intersect(packet, Coherence::kCoherent, kStaticOnly, &hits);
      // Each row of four asks for what one of its rays meets.
      const std::array asked = {hits.primitive[1], hits.primitive[6]};
      const Meetings8 found = instant.MeetStatic(packet, asked[0], asked[1]);
      for (std::size_t k = 0; k < kLanes; ++k) {
        if (asked[k / 4] == hits.primitive[k]) {
          EXPECT_EQ(found.t[k], hits.t[k]);
          EXPECT_EQ(found.on_rim[k], 0);
          ++met;
        } else if (found.on_rim[k] == 0 && found.t[k] > 0) {
          EXPECT_GE(found.t[k], hits.t[k] * (1 - 1e-5f)) << "nothing is before the nearest";
        } else {
          ++passed;
        }
      }
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(passed, 10);
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

/// Rays from anywhere in the hall to anywhere, a quarter of the lanes left out.
Rays8 RandomRays(cv::RNG* rng) {
  Rays8 rays;
  for (int k = 0; k < kLanes; ++k) {
    rays.ox[k] = rng->uniform(1.0f, 28.0f);
    rays.oy[k] = rng->uniform(-1.0f, 1.0f);
    rays.oz[k] = rng->uniform(0.2f, 2.0f);
    rays.dx[k] = rng->uniform(-1.0f, 1.0f);
    rays.dy[k] = rng->uniform(-1.0f, 1.0f);
    rays.dz[k] = rng->uniform(-1.0f, 1.0f);
    rays.t_near[k] = 0;
    rays.t_far[k] = rng->uniform(0.1f, 6.0f);
    rays.valid[k] = rng->uniform(0, 4) ? -1 : 0;
  }
  return rays;
}

TEST(Instant, OcclusionAgreesWithIntersection) {
  const World world(test::Hall({.boxes = 200}));
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose(world.At(kSecond));
  cv::RNG rng(3);
  for (int i = 0; i < 200; ++i) {
    const Rays8 rays = RandomRays(&rng);
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

TEST(Instant, PacketsSideBySideMeetWhatEachMeetsAlone) {
  const World world(test::Hall({.boxes = 200}));
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose(world.At(kSecond));
  cv::RNG rng(4);
  int met = 0;
  for (int i = 0; i < 60; ++i) {
    std::array<Rays8, Instant::kMostPackets> rays;
    for (Rays8& packet : rays) packet = RandomRays(&rng);
    const auto some = std::span(rays).first(1 + static_cast<std::size_t>(i) % rays.size());
    for (const GeometryMask mask : {kEverything, kStaticOnly, kMoversOnly}) {
      for (const Coherence coherence : {Coherence::kCoherent, Coherence::kIncoherent}) {
        std::array<Hits8, Instant::kMostPackets> together;
        std::array<unsigned, Instant::kMostPackets> blocked;
        instant.Intersect(some, coherence, mask, together);
        instant.Occluded(some, coherence, mask, blocked);
        for (std::size_t p = 0; p < some.size(); ++p) {
          Hits8 alone;
          instant.Intersect(some[p], coherence, mask, &alone);
          EXPECT_EQ(blocked[p], instant.Occluded(some[p], coherence, mask));
          for (int k = 0; k < kLanes; ++k) {
            ASSERT_EQ(together[p].geometry[k], alone.geometry[k]);
            if (alone.geometry[k] == kNoGeometry) continue;
            ++met;
            EXPECT_EQ(together[p].primitive[k], alone.primitive[k]);
            EXPECT_EQ(together[p].t[k], alone.t[k]);
            EXPECT_EQ(together[p].u[k], alone.u[k]);
            EXPECT_EQ(together[p].v[k], alone.v[k]);
          }
        }
      }
    }
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace aisle::sim
