#include "simulator/world/shell.h"

#include <gtest/gtest.h>

#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

const Eigen::Vector3f kInside(1, 0.5f, 1);

/// A hall of 10 x 8 x 5 m as a modeller's box: wound to be seen from outside.
test::MeshBuilder Outwards() {
  test::MeshBuilder hall;
  hall.Box({-4, -4, 0}, {6, 4, 5}, 0, 1);
  return hall;
}

/// All of one node.
void Turn(const Eigen::Vector3f& inside, TriangleMesh* mesh) {
  TurnShellInside(inside, std::vector<int>(mesh->triangles.size(), 1), mesh);
}

/// How many of the triangles from `first` on face the place, by winding and by normals.
int Facing(const TriangleMesh& mesh, std::size_t first = 0) {
  int facing = 0;
  for (std::size_t i = first; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3f &p = mesh.positions[a], to = kInside - p;
    const Eigen::Vector3f normal = (mesh.positions[b] - p).cross(mesh.positions[c] - p);
    EXPECT_EQ(to.dot(normal) > 0, to.dot(mesh.normals[a]) > 0);
    facing += to.dot(normal) > 0;
  }
  return facing;
}

TEST(TurnShellInside, AShellIsSeenFromWithin) {
  TriangleMesh hall = Outwards().mesh;
  ASSERT_EQ(Facing(hall), 0);
  Turn(kInside, &hall);
  EXPECT_EQ(Facing(hall), 12);
  const TriangleMesh turned = hall;
  Turn(kInside, &hall);
  EXPECT_EQ(hall.triangles, turned.triangles) << "once is enough";
}

TEST(TurnShellInside, AShellNeedsNoFloor) {
  TriangleMesh hall = Outwards().mesh;
  hall.triangles.erase(hall.triangles.begin(), hall.triangles.begin() + 2);
  hall.materials.resize(hall.triangles.size());
  Turn(kInside, &hall);
  EXPECT_EQ(Facing(hall), 10);
}

TEST(TurnShellInside, WhatStandsInItStaysAsItIs) {
  test::MeshBuilder hall = Outwards();
  const std::size_t shell = hall.mesh.triangles.size();
  hall.Box({3, -3, 0.1f}, {4, 3, 3}, 0, 1);
  const std::vector<std::array<std::uint32_t, 3>> before = hall.mesh.triangles;
  Turn(kInside, &hall.mesh);
  EXPECT_TRUE(std::equal(before.begin() + static_cast<std::ptrdiff_t>(shell), before.end(),
                         hall.mesh.triangles.begin() + static_cast<std::ptrdiff_t>(shell)));
  EXPECT_NE(hall.mesh.triangles, before);
}

TEST(TurnShellInside, AFloorThatFacesThePlaceGoesOnDoingSo) {
  // A slab of its own on the shell's floor, corner on corner.
  test::MeshBuilder hall = Outwards();
  const std::size_t shell = hall.mesh.triangles.size();
  hall.Quad({-4, -4, 0}, {10, 0, 0}, {0, 8, 0}, 0, 1);
  std::vector<int> nodes(hall.mesh.triangles.size(), 1);
  std::fill(nodes.begin() + static_cast<std::ptrdiff_t>(shell), nodes.end(), 2);
  TurnShellInside(kInside, nodes, &hall.mesh);
  EXPECT_EQ(Facing(hall.mesh), 14);
}

TEST(TurnShellInside, WallsWithAThicknessAndSolidsBesideStayAsTheyAre) {
  // The inner side of a wall of 0.2 m, and its outer side.
  TriangleMesh thick = Outwards().mesh;
  Turn(kInside, &thick);
  test::MeshBuilder outer;
  outer.mesh = thick;
  outer.Box({-4.2f, -4.2f, -0.2f}, {6.2f, 4.2f, 5.2f}, 0, 1);
  TriangleMesh hall = outer.mesh;
  Turn(kInside, &hall);
  EXPECT_EQ(hall.triangles, outer.mesh.triangles);
  TriangleMesh beside = Outwards().mesh;
  Turn({20, 0, 1}, &beside);
  EXPECT_EQ(beside.triangles, Outwards().mesh.triangles);
}

}  // namespace
}  // namespace aisle::sim
