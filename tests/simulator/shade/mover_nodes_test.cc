#include "simulator/shade/pass/mover_nodes.h"

#include <gtest/gtest.h>

#include <numeric>

#include "simulator/shade/surface/mesh_pieces.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// Two shells, one a centimetre inside the other, as a body in its clothes.
TriangleMesh Shells() {
  test::MeshBuilder builder;
  builder.Sphere({0, 0, 1}, {0.29f, 0.29f, 0.49f}, 24, 0, 1);
  builder.Sphere({0, 0, 1}, {0.3f, 0.3f, 0.5f}, 24, 0, 1);
  return builder.mesh;
}

std::vector<SurfacePoint> PointsOf(const TriangleMesh& mesh) {
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    points.push_back({mesh.positions[i], mesh.normals[i]});
  }
  return points;
}

TEST(MeshPieces, ShellsThatNoTriangleJoinsAreApartAndSeamsAreNot) {
  const TriangleMesh mesh = Shells();
  const std::vector<std::uint32_t> pieces = PiecesOf(mesh);
  const std::size_t half = pieces.size() / 2;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    // A sphere's first and last meridian are two rows of vertices in one place; its poles' rings
    // are single points, some in no triangle that has an area.
    EXPECT_EQ(pieces[i], i < half ? pieces[0] : pieces[half]) << i;
  }
  EXPECT_NE(pieces[0], pieces[half]);
}

TEST(MoverNodes, StandForNearPointsOfTheSamePieceThatFaceAlike) {
  const TriangleMesh mesh = Shells();
  const std::vector<SurfacePoint> points = PointsOf(mesh);
  const std::vector<std::uint32_t> pieces = PiecesOf(mesh);
  std::size_t coarser = points.size();
  for (const float spacing : {0.025f, 0.05f, 0.1f, 0.2f}) {
    const MoverNodes nodes = ChooseNodes(points, pieces, spacing);
    ASSERT_EQ(nodes.stencils.size(), points.size());
    EXPECT_LT(nodes.points.size(), coarser);
    coarser = nodes.points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      float sum = 0;
      for (std::size_t k = 0; k < MoverNodes::kNeighbours; ++k) {
        const float weight = nodes.stencils[i].weights[k];
        if (weight <= 0) continue;
        sum += weight;
        const std::uint32_t node = nodes.points[nodes.stencils[i].nodes[k]];
        EXPECT_EQ(pieces[node], pieces[i]);
        EXPECT_LT((points[node].position - points[i].position).norm(), 2 * spacing);
        EXPECT_GT(points[node].normal.dot(points[i].normal), 0.5f);
      }
      ASSERT_NEAR(sum, 1, 1e-5) << "point " << i << " at " << spacing;
    }
  }
}

TEST(MoverNodes, InOrderLieNearTheNextAndFaceAlike) {
  const TriangleMesh mesh = Shells();
  const std::vector<SurfacePoint> points = PointsOf(mesh);
  const MoverNodes nodes = ChooseNodes(points, PiecesOf(mesh), 0.05f);
  std::vector<std::uint32_t> sorted = nodes.in_order;
  std::ranges::sort(sorted);
  std::vector<std::uint32_t> all(nodes.points.size());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(sorted, all) << "each once";
  Eigen::AlignedBox3f body;
  for (const SurfacePoint& point : points) body.extend(point.position);
  double way = 0;
  int turned = 0;
  for (std::size_t i = 1; i < nodes.in_order.size(); ++i) {
    const SurfacePoint& a = points[nodes.points[nodes.in_order[i - 1]]];
    const SurfacePoint& b = points[nodes.points[nodes.in_order[i]]];
    way += (a.position - b.position).norm();
    turned += a.normal.dot(b.normal) < 0;
  }
  const double steps = static_cast<double>(nodes.in_order.size() - 1);
  EXPECT_LT(way / steps, 0.15 * body.sizes().norm());
  EXPECT_LT(turned, 0.02 * steps);
}

}  // namespace
}  // namespace aisle::sim
