#include "simulator/trace/overlaps.h"

#include <gtest/gtest.h>

#include "simulator/trace/tracer.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// Triangles by number: Box makes its lower face first, two triangles a face.
constexpr std::size_t kBox = 12;

test::MeshBuilder CartonOn(const Eigen::Vector3f& corner) {
  test::MeshBuilder mesh;
  mesh.Box(corner, corner + Eigen::Vector3f(0.4f, 0.3f, 0.2f), 0, 1);
  mesh.Quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, 0, 1);
  return mesh;
}

std::size_t Count(const std::vector<std::uint8_t>& marks) {
  return static_cast<std::size_t>(std::ranges::count(marks, 1));
}

TEST(FindOverlapped, MarksTheUndersideOfACartonAndNothingElse) {
  const std::vector<std::uint8_t> marks = FindOverlapped(CartonOn({1, 2, 0}).mesh);
  ASSERT_EQ(marks.size(), kBox + 2);
  EXPECT_EQ(Count(marks), 2u);
  const TriangleMesh mesh = CartonOn({1, 2, 0}).mesh;
  for (std::size_t i = 0; i < kBox; ++i) {
    const bool low = std::ranges::all_of(mesh.triangles[i],
                                         [&](auto at) { return mesh.positions[at].z() == 0; });
    EXPECT_EQ(marks[i], low);
  }
  EXPECT_EQ(Count(FindOverlapped(CartonOn({1, 2, 0.001f}).mesh)), 0u);
}

TEST(FindOverlapped, NeighboursThatShareAnEdgeDoNotOverlap) {
  test::MeshBuilder tiles;
  for (int i = 0; i < 9; ++i) {
    tiles.Quad({static_cast<float>(i % 3), static_cast<float>(i / 3), 1}, {1, 0, 0}, {0, 1, 0}, 0,
               1);
  }
  EXPECT_EQ(Count(FindOverlapped(tiles.mesh)), 0u);
}

TEST(Instant, OfTwoSurfacesInOnePlaneTheLargerIsHitWhicheverWasBuiltFirst) {
  for (const bool floor_first : {false, true}) {
    test::MeshBuilder both;
    const auto floor = [&] { both.Quad({-3, -3.3f, 0}, {7, 0, 0}, {0, 7, 0}, 0, 1); };
    if (floor_first) floor();
    for (int i = 0; i < 40; ++i) {
      both.Quad({-2 + 0.1f * static_cast<float>(i), -2, 0}, {0.09f, 0, 0}, {0, 4, 0}, 0, 1);
    }
    if (!floor_first) floor();
    WorldParts parts;
    parts.materials.resize(1);
    parts.lights.push_back({{0, 0, 5}, {1, 0, 0}, {0, -1, 0}, 1});
    parts.instances.push_back({"thing", ObjectClass::kFurniture, false});
    parts.statics = {both.mesh, both.instances};
    const World world(std::move(parts));
    const Tracer tracer(world, {});
    const Instant instant = tracer.Pose(world.At(0));
    cv::RNG rng(7);
    for (int i = 0; i < 300; ++i) {
      Rays8 rays;
      for (int k = 0; k < kLanes; ++k) {
        rays.ox[k] = rays.oy[k] = 0.3f;
        rays.oz[k] = 1.7f;
        rays.dx[k] = rng.uniform(-1.f, 1.f);
        rays.dy[k] = rng.uniform(-1.f, 1.f);
        rays.dz[k] = -1;
        rays.t_near[k] = 0;
        rays.t_far[k] = kInfinity;
        rays.valid[k] = -1;
      }
      Hits8 hits;
      instant.Intersect(rays, Coherence::kIncoherent, kEverything, &hits);
      for (int k = 0; k < kLanes; ++k) {
        EXPECT_EQ(hits.primitive[k] / 2, floor_first ? 0u : 40u);
      }
    }
  }
}

}  // namespace
}  // namespace aisle::sim
