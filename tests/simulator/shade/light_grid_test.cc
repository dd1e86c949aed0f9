#include "simulator/shade/surface/light_grid.h"

#include <gtest/gtest.h>

#include "simulator/shade/light/direct_light.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// Triangles of all shapes and sizes, corners in every order.
TriangleMesh Assorted() {
  TriangleMesh mesh;
  cv::RNG rng(4);
  for (int i = 0; i < 300; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const float size = std::exp(rng.uniform(-4.0f, 1.0f));
    for (int corner = 0; corner < 3; ++corner) {
      mesh.positions.emplace_back(size * rng.uniform(0.0f, 1.0f), size * rng.uniform(0.0f, 1.0f),
                                  size * rng.uniform(0.0f, 0.1f));
      mesh.normals.emplace_back(0, 0, 1);
      mesh.uvs.emplace_back(0, 0);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.materials.push_back(0);
  }
  return mesh;
}

float Linear(const Eigen::Vector3f& p) { return 5 + 0.3f * p.x() - 0.7f * p.y() + 0.2f * p.z(); }

Eigen::Vector3f At(const TriangleMesh& mesh, std::uint32_t triangle, float u, float v) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (1 - u - v) * mesh.positions[a] + u * mesh.positions[b] + v * mesh.positions[c];
}

TEST(LightGrid, ReproducesALinearFieldInsideEveryTriangle) {
  const TriangleMesh mesh = Assorted();
  const float texel = 0.1f;
  const LightGrid grid = MakeLightGrid(mesh, texel);
  std::vector<float> values, slots(grid.point_of_slot.size());
  for (const LightPoint& point : grid.points) {
    values.push_back(Linear(At(mesh, point.triangle, point.u, point.v)));
  }
  FillSlots(grid, values, slots);
  cv::RNG rng(5);
  double worst_small = 0, worst = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 20; ++k) {
      float u = rng.uniform(0.0f, 1.0f), v = rng.uniform(0.0f, 1.0f);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const double error =
          std::abs(ReadLight(grid.patches[i], slots, u, v) - Linear(At(mesh, i, u, v)));
      // One cell: the corner beyond the long edge is extrapolated, which is exact.
      (grid.patches[i].pitch == 2 ? worst_small : worst) =
          std::max(grid.patches[i].pitch == 2 ? worst_small : worst, error);
    }
  }
  // Elsewhere a clamped corner is wrong by at most the field's change over a cell.
  EXPECT_LT(worst, 0.8 * texel);
  EXPECT_LT(worst_small, 0.8 * texel);
}

TEST(LightGrid, NearestPointIsNear) {
  const TriangleMesh mesh = Assorted();
  const float texel = 0.1f;
  const LightGrid grid = MakeLightGrid(mesh, texel);
  cv::RNG rng(6);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 20; ++k) {
      float u = rng.uniform(0.0f, 1.0f), v = rng.uniform(0.0f, 1.0f);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const LightPoint& point = grid.points[NearestPoint(grid, i, u, v)];
      const Eigen::Vector3f there = At(mesh, point.triangle, point.u, point.v);
      EXPECT_LT((there - At(mesh, i, u, v)).norm(), 1.5f * texel);
    }
  }
}

TEST(GatherDirectLight, MatchesTheFormFactorOfARectangle) {
  // Irradiance below the centre of a rectangle 2a × 2b at height h, facing down (Howell, C-13):
  // four times the form factor of a quarter seen from its corner.
  WorldParts parts;
  parts.instances.push_back({"floor", ObjectClass::kFloor, false});
  parts.materials.resize(1);
  test::MeshBuilder floor;
  floor.Quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0, 1);
  parts.statics = {floor.mesh, floor.instances};
  const float a = 0.75f, b = 0.15f, h = 4;
  parts.lights.push_back({{0, 0, h}, {a, 0, 0}, {0, -b, 0}, 3});
  const World world(std::move(parts));
  const Tracer tracer(world, {});
  const std::vector<SurfacePoint> points = {{{0, 0, 0.002f}, {0, 0, 1}}};
  const std::vector<float> scale = {1};
  const float light = GatherDirectLight(tracer.Pose({}), world.lights(), scale, points, {})[0];
  const double x = a / h, y = b / h;
  const double quarter = (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
                          y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
                         (2 * M_PI);
  // Four points along a light as long as 3/8 of its distance: a quadrature error of 0.3 %.
  EXPECT_NEAR(light, M_PI * 3 * 4 * quarter, 5e-3 * light);
}

TEST(LightGrid, PointsAboutAreThoseOfTheLargerTriangles) {
  const TriangleMesh mesh = Assorted();
  for (const float texel : {0.02f, 0.05f, 0.3f}) {
    const LightGrid grid = MakeLightGrid(mesh, texel);
    EXPECT_EQ(grid.spacing_m, texel);
    std::size_t larger = 0;
    for (const LightPoint& point : grid.points) {
      const LightPatch& patch = grid.patches[point.triangle];
      larger += patch.pitch > 2 || std::max({patch.t0, patch.tu, patch.tv}) > 1 ? 1 : 0;
    }
    const auto about = static_cast<double>(PointsAbout(mesh, texel));
    EXPECT_NEAR(about, static_cast<double>(larger), 0.25 * static_cast<double>(larger)) << texel;
  }
}

}  // namespace
}  // namespace aisle::sim
