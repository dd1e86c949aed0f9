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
        Compare(RasterizeThroughLens(world, snapshot, rays, pose), truth.depth, truth.instance);
    EXPECT_GT(agreement.compared, camera.width * camera.height / 3);
    EXPECT_GE(agreement.share(), 0.999);
  }
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
