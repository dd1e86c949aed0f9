#include "simulator/proof/light_proof.h"

#include <gtest/gtest.h>

#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// Whether the light of a world is judged by the path tracer at all.
bool IsJudged(WorldParts parts) {
  const World world(std::move(parts));
  const Tracer tracer(world, {});
  const Shader shader(world, tracer,
                      {.statics = {.texel_m = 1,
                                   .coarse_texel_m = 2,
                                   .volume_spacing_m = 3,
                                   .directions = 4,
                                   .volume_directions = 4}});
  StereoCamera camera;
  camera.width = 48;
  camera.height = 32;
  camera.fx = camera.fy = 40;
  camera.cx = 23.5;
  camera.cy = 15.5;
  const PixelRays rays = MakePixelRays(camera);
  const Studio studio{world, tracer, shader, camera, rays, MovingOptions{}};
  try {
    CheckLight(studio, {.T_world_rig = test::LookAlong({3, 0.3, 1.2}, 0)}, 2, 2);
  } catch (const std::runtime_error&) {
    return false;
  }
  return true;
}

TEST(CheckLight, RefusesWhatThePathTracerDoesNotDraw) {
  const auto hall = [] { return test::Hall({.boxes = 20, .lights = 2}); };
  EXPECT_TRUE(IsJudged(hall()));
  WorldParts beams = hall();
  beams.has_beams = true;
  EXPECT_FALSE(IsJudged(std::move(beams)));
  WorldParts panes = hall();
  panes.materials[4].transmission = 0.9f;  // of the figure
  EXPECT_FALSE(IsJudged(std::move(panes)));
}

}  // namespace
}  // namespace aisle::sim
