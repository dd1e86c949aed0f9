#include "simulator/shade/light/point_groups.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "simulator/shade/light/direct_light.h"
#include "simulator/shade/light/shared_visibility.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

/// A floor, and leaves of 8 cm above it: quads that face up, each of two triangles with vertices of
/// their own, and one bent strip of so small triangles that is a metre long.
TriangleMesh FloorAndLeaves(int leaves) {
  test::MeshBuilder mesh;
  mesh.Quad({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 0, 0);
  for (int i = 0; i < leaves; ++i) {
    const auto x = static_cast<float>(i);
    mesh.Quad({0.2f + 0.13f * x, 1, 1 + 0.002f * x}, {0.08f, 0, 0}, {0, 0.08f, 0}, 0, 0);
  }
  for (int i = 0; i < 16; ++i) {
    mesh.Quad({0.0625f * static_cast<float>(i), 3, 1}, {0.0625f, 0, 0}, {0, 0.0625f, 0}, 0, 0);
  }
  return mesh.mesh;
}

std::vector<SurfacePoint> PointsOf(const LightGrid& grid, const TriangleMesh& mesh) {
  return LocatePoints(grid, mesh, mesh.positions, mesh.normals);
}

TEST(LooseThings, AreWhatIsSmallAndTouchesNothing) {
  constexpr int kLeaves = 9;
  const TriangleMesh mesh = FloorAndLeaves(kLeaves);
  const LightGrid grid = MakeLightGrid(mesh, 0.2f);
  const std::vector<std::uint32_t> things = LooseThings(grid, mesh, ThingsOf(mesh));
  std::set<std::uint32_t> loose;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const Vector3f at = PointsOf(grid, mesh)[i].position;
    const bool of_leaf = at.z() > 0.5f && at.y() < 2;
    EXPECT_EQ(things[i] != kFixed, of_leaf) << at.transpose();
    if (of_leaf) loose.insert(things[i]);
  }
  EXPECT_EQ(loose.size(), kLeaves) << "each leaf is one";
}

TEST(GroupsOfThings, AreTheFacingsOfEach) {
  const std::vector<SurfacePoint> points = {{{0, 0, 0}, {0, 0, 1}},
                                            {{0.1f, 0, 0}, {0, 0, 1}},
                                            {{0, 0, 0}, {0, 0, -1}},
                                            {{0, 0, 0}, {0, 0, 1}}};
  const std::vector<std::uint32_t> things = {7, 7, 7, 8};
  EXPECT_EQ(GroupsOfThings(points, things), (std::vector<std::uint32_t>{0, 0, 2, 3}));
}

TEST(Groups, AreNearAlikeAndLedByOneOfTheirOwn) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> place(0, 0.5f), way(-1, 1);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 3000; ++i) {
    points.push_back({{place(random), place(random), place(random)},
                      Vector3f(way(random), way(random), way(random)).normalized()});
  }
  const GroupOptions options;
  const std::vector<std::uint32_t> leaders = GroupsOf(points, {}, options);
  std::size_t groups = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_LE(leaders[i], i) << "its group's first";
    EXPECT_EQ(leaders[leaders[i]], leaders[i]);
    groups += leaders[i] == i;
    const SurfacePoint &a = points[i], &b = points[leaders[i]];
    EXPECT_LE((a.position - b.position).cwiseAbs().maxCoeff(), options.cell_m + 1e-5f);
    EXPECT_LE((a.normal - b.normal).cwiseAbs().maxCoeff(), 1 / options.normal_steps + 1e-5f);
  }
  EXPECT_LT(groups, points.size());
}

/// Leaves of a tree lie on no common plane, boards in a stack do.
TEST(Groups, OfLooseThingsKnowNoPlane) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back({{0.1f, 0.1f, 0.1f + 0.02f * static_cast<float>(i)}, {0, 0, 1}});
  }
  const GroupOptions options{.cell_m = 0.5f, .plane_m = 0.02f};
  const auto groups = [&](std::uint32_t thing) {
    const std::vector<std::uint32_t> things(points.size(), thing);
    const auto leaders = GroupsOf(points, things, options);
    return std::set(leaders.begin(), leaders.end()).size();
  };
  EXPECT_EQ(groups(3), 1);
  EXPECT_GE(groups(kFixed), 7);
}

/// Under one lamp, with nothing in between, what is shared is what each point would have had.
TEST(SharedVisibility, IsExactWhereNothingHidesTheLamps) {
  const TriangleMesh mesh = FloorAndLeaves(9);
  const LightGrid grid = MakeLightGrid(mesh, 0.2f);
  const std::vector<AreaLight> lights = {{{2, 2, 4}, {0.5f, 0, 0}, {0, -0.5f, 0}, 10}};
  const std::vector<float> on = {1};
  const std::vector<SurfacePoint> places = PointsOf(grid, mesh);
  const std::vector<std::uint32_t> things = LooseThings(grid, mesh, ThingsOf(mesh));
  const SharedVisibility shared = ShareVisibility(things, places, lights, on);
  EXPECT_LT(shared.traced.size(), places.size());
  EXPECT_EQ(shared.fixed, static_cast<std::size_t>(std::ranges::count(things, kFixed)));
  const auto unshadowed = [&](std::uint32_t point) {
    return UnshadowedLight(lights, on, std::span(places).subspan(point, 1))[0];
  };
  std::vector<float> traced;
  for (const std::uint32_t point : shared.traced) traced.push_back(unshadowed(point));
  const std::vector<float> light = shared.Spread(traced);
  ASSERT_EQ(light.size(), places.size());
  for (std::uint32_t i = 0; i < light.size(); ++i) {
    EXPECT_NEAR(light[i], unshadowed(i), 1e-5f * (1 + light[i]));
    EXPECT_EQ(things[shared.traced[shared.of_point[i]]], things[i]);
    EXPECT_LE(shared.share[i], 1);
  }
  // Half of it hidden: half of it for all who share.
  for (float& value : traced) value /= 2;
  const std::vector<float> halved = shared.Spread(traced);
  for (std::size_t i = 0; i < light.size(); ++i) EXPECT_NEAR(halved[i], light[i] / 2, 1e-5f);
}

}  // namespace
}  // namespace aisle::sim
