#include "simulator/truth/correspondence.h"

#include <gtest/gtest.h>

#include "simulator/scene/load.h"
#include "simulator/truth/truth.h"
#include "simulator/world/build.h"
#include "tests/simulator/test_world.h"
#include "tests/simulator/world/mechanism_scene.h"

namespace aisle::sim {
namespace {

constexpr std::int64_t kFrame = 50'000'000;

struct Pictures {
  StereoCamera camera;
  PixelRays rays;
  cv::Mat1f depth_left, depth_right, depth_next, z_next;
  Correspondence found;
  CameraTruth truth;
};

Pictures Take(std::int64_t stamp_ns, const Lens& lens = {}) {
  const World world(test::Hall({.boxes = 200}));
  const Tracer tracer(world, {});
  Pictures p;
  p.camera.lens = lens;
  p.rays = MakePixelRays(p.camera);
  const PixelRays& rays = p.rays;
  const Eigen::Isometry3d rig = test::LookAlong({2, 0.1, 1.2}, 0.03);
  const Eigen::Isometry3d rig_next = test::LookAlong({2.06, 0.1, 1.2}, 0.04);
  const Instant now = tracer.Pose(world.At(stamp_ns)),
                next = tracer.Pose(world.At(stamp_ns + kFrame));
  const std::array views = {CameraView(rays, rig),
                            CameraView(rays, CameraPose(p.camera, rig, StereoSide::kRight))};
  const std::array views_next = {CameraView(rays, rig_next)};
  std::vector<HitImage> hits, hits_next;
  TraceViews(now, views, {}, &hits);
  TraceViews(next, views_next, {}, &hits_next);
  const MovingNow moving(world, now.snapshot(), {}), moving_then(world, next.snapshot(), {});
  p.truth = LabelHits(world, now, hits[0], moving);
  p.depth_left = p.truth.depth;
  p.depth_right = LabelHits(world, now, hits[1], moving).depth;
  p.depth_next = LabelHits(world, next, hits_next[0], moving_then).depth;
  p.found = FindCorrespondence(world, now, p.camera, views[0], hits[0], next.snapshot(), rig_next);
  p.z_next = DepthInNextCamera(views[0], hits[0], p.found, rig_next);
  return p;
}

TEST(Correspondence, WarpsAgreeInGeometry) {
  const Pictures p = Take(2'000'000'000);
  const WarpCheck stereo = CheckStereo(p.camera, p.rays, p.depth_left, p.depth_right, p.found);
  EXPECT_GT(stereo.compared, 200'000);
  EXPECT_LE(stereo.median_px, 0.05);
  EXPECT_LE(stereo.p95_px, 0.05);
  const WarpCheck flow = CheckFlow(p.camera, p.z_next, p.depth_next, p.found.flow);
  EXPECT_GT(flow.compared, 200'000);
  EXPECT_LE(flow.median_px, 0.05);
  EXPECT_LE(flow.p95_px, 0.05);
}

TEST(Correspondence, WarpsAgreeThroughALens) {
  for (const Lens& lens : {Lens{LensModel::kRadialTangential, {-0.28, 0.074, 0.0002, 0.00002}},
                           Lens{LensModel::kEquidistant, {-0.01, 0.02, -0.01, 0.002}}}) {
    const Pictures p = Take(2'000'000'000, lens);
    const WarpCheck stereo = CheckStereo(p.camera, p.rays, p.depth_left, p.depth_right, p.found);
    EXPECT_GT(stereo.compared, 200'000);
    EXPECT_LE(stereo.median_px, 0.05);
    const WarpCheck flow = CheckFlow(p.camera, p.z_next, p.depth_next, p.found.flow);
    EXPECT_GT(flow.compared, 200'000);
    EXPECT_LE(flow.median_px, 0.05);
  }
}

/// A wall so near that most of what the left camera sees of it is far off the right one's axis,
/// where the polynomial of its lens comes back into the image.
TEST(Correspondence, WhatTheLensWouldFoldIntoTheImageIsNotSeen) {
  StereoCamera camera{.fx = 700, .fy = 700, .cx = 375.5, .cy = 239.5, .baseline_m = 1};
  camera.lens = {LensModel::kRadialTangential, {-0.3, 0, 0, 0}};
  WorldParts parts = test::Hall({.boxes = 1, .movers = false});
  test::MeshBuilder wall;
  wall.Quad({0.95f, 50, -50}, {0, -100, 0}, {0, 0, 100}, 0, 1);
  parts.statics = {wall.mesh, wall.instances};
  const World world(std::move(parts));
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose(world.At(0));
  const PixelRays rays = MakePixelRays(camera);
  const Eigen::Isometry3d rig = test::LookAlong({0, 0, 0}, 0);
  const CameraView left(rays, rig);
  std::vector<HitImage> hits;
  TraceViews(instant, std::span(&left, 1), {}, &hits);
  const Correspondence found =
      FindCorrespondence(world, instant, camera, left, hits[0], instant.snapshot(),
                         CameraPose(camera, rig, StereoSide::kRight));
  int seen = 0, folded = 0;
  for (int y = 200; y < 280; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const double aside = rays.At(x, y).x() - 1 / 0.95;  // tangent, from the right camera
      const double edge = rays.At(0, y).x();
      if (std::abs(aside - edge) < 0.01) continue;
      const bool in_image = aside > edge;
      EXPECT_EQ(found.occluded(y, x) == 0, in_image) << x << ", " << y;
      EXPECT_EQ(std::isnan(found.flow(y, x)[0]), std::hypot(aside, rays.At(x, y).y()) > 1.0541)
          << x << ", " << y;
      seen += in_image;
      folded += std::isnan(found.flow(y, x)[0]);
    }
  }
  EXPECT_GT(seen, 1000);
  EXPECT_GT(folded, 10'000);
}

TEST(Correspondence, AWrongBaselineWouldBeSeen) {
  Pictures p = Take(2'000'000'000);
  p.found.disparity *= 1.05;
  EXPECT_GT(CheckStereo(p.camera, p.rays, p.depth_left, p.depth_right, p.found).median_px, 0.05);
}

TEST(Correspondence, SceneFlowIsTheMoversWayAndNothingElse) {
  const Pictures p = Take(2'000'000'000);
  int movers = 0;
  for (int y = 0; y < p.camera.height; ++y) {
    for (int x = 0; x < p.camera.width; ++x) {
      const cv::Vec3f& way = p.found.scene_flow(y, x);
      const double expected = p.truth.instance(y, x) == 5   ? 0.6 * 0.05
                              : p.truth.instance(y, x) == 6 ? 0.8 * 0.05
                                                            : 0;
      movers += expected > 0;
      EXPECT_NEAR(cv::norm(way), expected, 2e-5);
    }
  }
  EXPECT_GT(movers, 2000);
}

/// A belt in the open, one box of which begins anew at its other end while another one goes on.
TEST(Correspondence, WhatComesRoundIsGone) {
  const World world = BuildWorld(ParseScene(kHall + R"(mechanisms:
  - name: belt
    at: [4, -1]
    heading_deg: 90
    parts:
      - {size_m: [0.4, 0.4, 0.4], at_m: [0, 0, 1], count: 2, joint: {kind: belt, axis: [1, 0, 0], speed_mps: 0.4, length_m: 2}}
)",
                                            "s.yaml"),
                                 std::string(AISLE_SOURCE_DIR) + "/assets", 1);
  const Tracer tracer(world, {});
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  const Eigen::Isometry3d rig = test::LookAlong({0, 0, 1}, 0);
  const CameraView left(rays, rig);
  constexpr std::int64_t kRound = 5'000'000'000;
  for (const bool comes_round : {false, true}) {
    const std::int64_t stamp_ns = comes_round ? kRound - kFrame / 2 : kRound / 4;
    const Instant now = tracer.Pose(world.At(stamp_ns));
    std::vector<HitImage> hits;
    TraceViews(now, std::span(&left, 1), {}, &hits);
    const Correspondence found =
        FindCorrespondence(world, now, camera, left, hits[0], world.At(stamp_ns + kFrame), rig);
    int gone = 0, goes_on = 0;
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const std::size_t i = hits[0].Index(x, y);
        if (hits[0].geometry[i] == 0 || hits[0].geometry[i] == kNoGeometry) continue;
        const cv::Vec3f& way = found.scene_flow(y, x);
        ASSERT_EQ(std::isnan(way[0]), std::isnan(found.flow(y, x)[0]));
        if (std::isnan(way[0])) {
          ++gone;
        } else {
          ASSERT_NEAR(cv::norm(way), 0.4 * 0.05, 1e-5);
          ++goes_on;
        }
        EXPECT_GT(found.disparity(y, x), 0);
      }
    }
    EXPECT_GT(goes_on, 1000);
    if (comes_round) {
      EXPECT_GT(gone, 1000);
    } else {
      EXPECT_EQ(gone, 0);
    }
  }
}

TEST(Correspondence, OcclusionIsBesideNearThings) {
  const Pictures p = Take(2'000'000'000);
  const double share =
      cv::countNonZero(p.found.occluded) / static_cast<double>(p.found.occluded.total());
  EXPECT_GT(share, 0.005);
  EXPECT_LT(share, 0.25);
}

}  // namespace
}  // namespace aisle::sim
