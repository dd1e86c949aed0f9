#include "simulator/raster/raster.h"

#include <gtest/gtest.h>

#include "simulator/camera/pixel_rays.h"
#include "simulator/trace/hit_image.h"
#include "simulator/truth/truth.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

TEST(Raster, AgreesWithTheRayTracerAwayFromSilhouettes) {
  const World world(test::Hall({.boxes = 400}));
  const Tracer tracer(world, {});
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  for (const double x : {1.5, 5.0}) {
    const Eigen::Isometry3d pose = test::LookAlong({x, 0.2, 1.3}, 0.1 * x - 0.2);
    const Snapshot snapshot = world.At(1'500'000'000);
    const Instant instant = tracer.Pose(snapshot);
    std::vector<HitImage> hits;
    const std::array views = {CameraView(rays, pose)};
    TraceViews(instant, views, {}, &hits);
    const MovingNow moving(world, instant.snapshot(), {});
    const CameraTruth truth = LabelHits(world, instant, hits[0], moving);
    const Agreement agreement =
        Compare(Rasterize(world, snapshot, camera, pose), truth.depth, truth.instance);
    EXPECT_GT(agreement.compared, camera.width * camera.height / 2);
    EXPECT_GE(agreement.share(), 0.999);
  }
}

TEST(Raster, AgreesThroughALens) {
  const World world(test::Hall({.boxes = 400}));
  const Tracer tracer(world, {});
  const Eigen::Isometry3d pose = test::LookAlong({1.5, 0.2, 1.3}, 0.1);
  const Snapshot snapshot = world.At(1'500'000'000);
  const Instant instant = tracer.Pose(snapshot);
  for (const Lens& lens : {Lens{LensModel::kRadialTangential, {-0.28, 0.074, 0.0002, 0.00002}},
                           Lens{LensModel::kEquidistant, {-0.01, 0.02, -0.01, 0.002}}}) {
    StereoCamera camera;
    camera.lens = lens;
    const PixelRays rays = MakePixelRays(camera);
    std::vector<HitImage> hits;
    const std::array views = {CameraView(rays, pose)};
    TraceViews(instant, views, {}, &hits);
    const MovingNow moving(world, instant.snapshot(), {});
    const CameraTruth truth = LabelHits(world, instant, hits[0], moving);
    const Agreement agreement =
        Compare(RasterizeThroughLens(world, snapshot, camera, pose), truth.depth, truth.instance);
    EXPECT_GT(agreement.compared, camera.width * camera.height / 3);
    EXPECT_GE(agreement.share(), 0.999);
  }
}

/// A wrong lens must not agree with itself.
TEST(Raster, AnotherLensWouldBeSeen) {
  const World world(test::Hall({.boxes = 400}));
  const Tracer tracer(world, {});
  const Eigen::Isometry3d pose = test::LookAlong({1.5, 0.2, 1.3}, 0.1);
  const Instant instant = tracer.Pose(world.At(0));
  StereoCamera camera;
  camera.lens = {LensModel::kRadialTangential, {-0.28, 0.074, 0.0002, 0.00002}};
  const PixelRays rays = MakePixelRays(camera);
  std::vector<HitImage> hits;
  TraceViews(instant, std::array{CameraView(rays, pose)}, {}, &hits);
  const MovingNow moving(world, instant.snapshot(), {});
  const CameraTruth truth = LabelHits(world, instant, hits[0], moving);
  camera.lens.coefficients[0] += 0.01;
  const RasterView other = RasterizeThroughLens(world, instant.snapshot(), camera, pose);
  EXPECT_LT(Compare(other, truth.depth, truth.instance).share(), 0.99);
}

TEST(Raster, AgreesHoweverFarTheWorldReaches) {
  WorldParts parts = test::Hall({.boxes = 400, .movers = false});
  for (Eigen::Vector3f& corner : parts.statics.mesh.positions) corner *= 10;  // 300 m long
  const World world(std::move(parts));
  const Tracer tracer(world, {});
  const StereoCamera camera;
  const PixelRays rays = MakePixelRays(camera);
  const Eigen::Isometry3d pose = test::LookAlong({15, 2, 13}, 0.02);
  const Instant instant = tracer.Pose(world.At(0));
  std::vector<HitImage> hits;
  TraceViews(instant, std::array{CameraView(rays, pose)}, {}, &hits);
  const MovingNow moving(world, instant.snapshot(), {});
  const CameraTruth truth = LabelHits(world, instant, hits[0], moving);
  ASSERT_GT(cv::countNonZero(truth.depth > 200), 0.01 * static_cast<double>(truth.depth.total()));
  const RasterView drawn = Rasterize(world, instant.snapshot(), camera, pose);
  EXPECT_GE(Compare(drawn, truth.depth, truth.instance).share(), 0.999);
}

TEST(Raster, WhatSawNothingAgreesWithNothing) {
  const StereoCamera camera;
  const cv::Size size(camera.width, camera.height);
  const RasterView blind{cv::Mat1f(size, std::numeric_limits<float>::quiet_NaN()),
                         cv::Mat1w(size, std::uint16_t{0})};
  const Agreement agreement =
      Compare(blind, cv::Mat1f(size, 2.0f), cv::Mat1w(size, std::uint16_t{0}));
  EXPECT_EQ(agreement.compared, 0);
  EXPECT_EQ(agreement.share(), 0);
}

TEST(Raster, AShiftOfHalfAPixelWouldBeSeen) {
  const World world(test::Hall({.boxes = 400}));
  StereoCamera camera;
  const Eigen::Isometry3d pose = test::LookAlong({1.5, 0.2, 1.3}, 0);
  const RasterView right = Rasterize(world, world.At(0), camera, pose);
  camera.cx += 0.5;
  const RasterView shifted = Rasterize(world, world.At(0), camera, pose);
  EXPECT_LT(Compare(right, shifted.depth, shifted.instance).share(), 0.99);
}

}  // namespace
}  // namespace aisle::sim
