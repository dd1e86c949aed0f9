#include <gtest/gtest.h>

#include "simulator/shade/shader.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// The hall whose truck wears a second skin under the one that is seen, first in the mesh, as a
/// body comes before its clothes.
WorldParts WithLayerBelow(WorldParts parts) {
  test::MeshBuilder truck;
  truck.Box({-0.98f, -0.48f, 0.12f}, {0.98f, 0.48f, 1.88f}, 4, 6, 1.0f);
  truck.Box({-1, -0.5f, 0.1f}, {1, 0.5f, 1.9f}, 4, 6, 1.0f);
  parts.mover_meshes[1] = truck.mesh;
  parts.at = [mesh = truck.mesh, plain = parts.at](std::int64_t stamp_ns) {
    Snapshot snapshot = plain(stamp_ns);
    MoverState& state = snapshot.movers[1];
    const Eigen::Vector3f place = state.T_world_object.translation().cast<float>();
    state.positions.clear();
    for (const Eigen::Vector3f& p : mesh.positions) state.positions.push_back(p + place);
    state.velocities.assign(mesh.positions.size(), state.velocities.front());
    state.normals = mesh.normals;
    return snapshot;
  };
  return parts;
}

cv::Mat1f Shaded(const World& world, cv::Mat1b* truck) {
  StereoCamera camera;
  camera.width = 160;
  camera.height = 120;
  camera.fx = camera.fy = 110;
  camera.cx = 79.5;
  camera.cy = 59.5;
  const Tracer tracer(world, {});
  const PixelRays rays = MakePixelRays(camera);
  const std::array views = {EyeView(rays, test::LookAlong({10.2, 0.2, 1.2}, 0))};
  const Instant instant = tracer.Pose(world.At(2'000'000'000));
  std::vector<HitImage> hits;
  TraceViews(instant, views, {}, &hits);
  truck->create(camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      (*truck)(y, x) = hits[0].geometry[hits[0].Index(x, y)] == 2 ? 255 : 0;
    }
  }
  return Shader(world, tracer, {.statics = {}, .antialias = false}).Shade(instant, views, hits)[0];
}

TEST(LightOnMovers, ALayerThatNobodySeesTakesNoLight) {
  const WorldParts plain = test::Hall({.boxes = 0, .lights = 8});
  cv::Mat1b truck, same;
  const cv::Mat1f expected = Shaded(World(plain), &truck);
  const cv::Mat1f layered = Shaded(World(WithLayerBelow(plain)), &same);
  ASSERT_GT(cv::countNonZero(truck), 1000);
  EXPECT_EQ(cv::countNonZero(truck != same), 0);
  EXPECT_NEAR(cv::mean(layered, truck)[0], cv::mean(expected, truck)[0],
              0.03 * cv::mean(expected, truck)[0]);
}

}  // namespace
}  // namespace aisle::sim
