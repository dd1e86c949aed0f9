#include "simulator/world/forms.h"

#include <gtest/gtest.h>

#include <numbers>

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

/// Of a closed surface, by the divergence theorem; negative where it is inside out.
double VolumeOf(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3f across = mesh.positions[b].cross(mesh.positions[c]);
    volume += static_cast<double>(mesh.positions[a].dot(across)) / 6;
  }
  return volume;
}

/// Every vertex's normal is a unit and looks to the side its triangles look to.
void ExpectNormalsOutside(const TriangleMesh& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3f across =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    if (across.norm() < 1e-9f) continue;
    for (const std::uint32_t v : {a, b, c}) {
      EXPECT_NEAR(mesh.normals[v].norm(), 1, 1e-4);
      EXPECT_GT(mesh.normals[v].dot(across.normalized()), 0.5f);
    }
  }
}

TEST(Rounded, IsABoxLessItsEdges) {
  TriangleMesh sharp, mesh;
  const Vector3f size(1.2f, 0.8f, 0.5f);
  AddRounded(&sharp, At(3, -2, 1, 0.7f), size, 1e-4f, 0);
  EXPECT_NEAR(VolumeOf(sharp), size.prod(), 1e-3);
  AddRounded(&mesh, At(3, -2, 1, 0.7f), size, 0.05f, 0);
  EXPECT_LT(VolumeOf(mesh), 0.995 * size.prod());
  EXPECT_GT(VolumeOf(mesh), 0.95 * size.prod());
  ExpectNormalsOutside(mesh);
}

TEST(Tube, HoldsWhatItsLengthAndSectionSay) {
  TriangleMesh mesh;
  const std::vector<Vector3f> way = Smooth({{0, 0, 1}, {1, 0, 1}, {2, 1, 1.5f}, {2, 3, 0.5f}}, 12);
  AddTube(&mesh, way, 0.03f, 24, 0);
  float length = 0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  EXPECT_NEAR(VolumeOf(mesh), length * kPi * 0.03f * 0.03f, 0.03 * VolumeOf(mesh));
  ExpectNormalsOutside(mesh);
}

TEST(Turned, IsPappusVolume) {
  TriangleMesh mesh;  // a cone frustum on a cylinder
  AddTurned(&mesh, At(1, 2, 0.5f, 0.3f), {{0, 0}, {0.4f, 0}, {0.4f, 1}, {0.2f, 1.6f}, {0, 1.6f}},
            96, 0);
  const double cylinder = kPi * 0.16, frustum = kPi * 0.6 / 3 * (0.16 + 0.08 + 0.04);
  EXPECT_NEAR(VolumeOf(mesh), cylinder + frustum, 0.005);
  ExpectNormalsOutside(mesh);
}

TEST(Sheet, LooksBothWays) {
  TriangleMesh mesh;
  AddSheet(&mesh, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 2, 0);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_NEAR(mesh.normals.front().z(), 1, 1e-6);
  EXPECT_NEAR(mesh.normals.back().z(), -1, 1e-6);
  ExpectNormalsOutside(mesh);
}

TEST(Hanging, SagsInTheMiddle) {
  const auto way = Hanging({0, 0, 3}, {4, 0, 3}, 0.5f, 10);
  EXPECT_EQ(way.front(), Vector3f(0, 0, 3));
  EXPECT_TRUE(way.back().isApprox(Vector3f(4, 0, 3)));
  EXPECT_NEAR(way[5].z(), 2.5f, 1e-6);
}

TEST(Spot, LiesFlatAndLooksUp) {
  TriangleMesh mesh;
  AddSpot(&mesh, At(2, 1, 0.002f, 1), {0.4f, 0.2f}, 0.15f, Dice(1, {}), 0);
  for (const Vector3f& at : mesh.positions) EXPECT_FLOAT_EQ(at.z(), 0.002f);
  ExpectNormalsOutside(mesh);
}

}  // namespace
}  // namespace aisle::sim
