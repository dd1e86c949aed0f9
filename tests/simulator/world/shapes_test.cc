#include "simulator/world/shapes.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tests/simulator/world/mesh_items.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using std::numbers::pi;

/// By the divergence theorem: a closed mesh whose triangles look outwards encloses this volume,
/// and the area vectors of its triangles cancel.
double VolumeOf(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.positions[a].dot(mesh.positions[b].cross(mesh.positions[c])) / 6;
  }
  return volume;
}

Vector3f OpenArea(const TriangleMesh& mesh) {
  Vector3f sum = Vector3f::Zero();
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]) / 2;
  }
  return sum;
}

void ExpectNormalsOfTriangles(const TriangleMesh& mesh, float least_cosine) {
  for (const auto& triangle : mesh.triangles) {
    const Vector3f across = (mesh.positions[triangle[1]] - mesh.positions[triangle[0]])
                                .cross(mesh.positions[triangle[2]] - mesh.positions[triangle[0]])
                                .normalized();
    for (const std::uint32_t corner : triangle) {
      EXPECT_NEAR(mesh.normals[corner].norm(), 1, 1e-5);
      EXPECT_GT(across.dot(mesh.normals[corner]), least_cosine);
    }
  }
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float In(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  Vector3f Point(float low, float high) { return {In(low, high), In(low, high), In(low, high)}; }
  Eigen::Isometry3f Pose() {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.linear() = Eigen::AngleAxisf(In(-3, 3), Point(-1, 1).normalized()).toRotationMatrix();
    pose.translation() = Point(-5, 5);
    return pose;
  }

 private:
  std::mt19937 engine_;
};

TEST(AddBox, EnclosesItsVolumeAnywhereAndLooksOutwards) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    const Vector3f size = random.Point(0.1f, 3);
    TriangleMesh mesh;
    AddBox(&mesh, random.Pose(), size, BoxPaint::Whole(0));
    EXPECT_NEAR(VolumeOf(mesh), size.prod(), 2e-3) << seed;
    EXPECT_LT(OpenArea(mesh).norm(), 1e-3) << seed;
    ExpectNormalsOfTriangles(mesh, 0.999f);
    EXPECT_EQ(test::ItemsOf(mesh).size(), 1u) << "its faces meet";
  }
}

TEST(AddBox, BetweenTwoCornersFillsExactlyThatSpace) {
  TriangleMesh mesh;
  AddBox(&mesh, Vector3f(1, 2, 3), Vector3f(2, 4, 6), BoxPaint::Whole(0));
  const test::Box box = test::ItemsOf(mesh).front();
  EXPECT_TRUE(box.min().isApprox(Vector3f(1, 2, 3)));
  EXPECT_TRUE(box.max().isApprox(Vector3f(2, 4, 6)));
}

TEST(AddBox, AFaceLeftOutIsThatFaceAlone) {
  const std::array<Vector3f, 6> normals = {Vector3f::UnitX(), -Vector3f::UnitX(),
                                           Vector3f::UnitY(), -Vector3f::UnitY(),
                                           Vector3f::UnitZ(), -Vector3f::UnitZ()};
  for (std::size_t face = 0; face < 6; ++face) {
    BoxPaint paint = BoxPaint::Whole(0);
    paint.faces = kAllFaces & ~(1u << face);
    TriangleMesh mesh;
    AddBox(&mesh, At(1, 2, 3, 0.4f), {1, 1, 1}, paint);
    const Vector3f missing = At(0, 0, 0, 0.4f).linear() * normals[face];
    EXPECT_TRUE(OpenArea(mesh).isApprox(-missing, 1e-4f)) << face;
  }
}

/// A tiled texture has one scale on all faces: every edge is as many repeats as it is tiles long.
TEST(AddBox, ATiledTextureKeepsItsNaturalSizeOnEveryFace) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Vector3f size = random.Point(0.1f, 3);
    const float tile_m = random.In(0.2f, 2);
    TriangleMesh mesh;
    AddBox(&mesh, random.Pose(), size, BoxPaint::Tiled(0, size, tile_m));
    for (const auto& [a, b, c] : mesh.triangles) {
      EXPECT_NEAR((mesh.uvs[b] - mesh.uvs[a]).norm() * tile_m,
                  (mesh.positions[b] - mesh.positions[a]).norm(), 1e-3);
      EXPECT_NEAR((mesh.uvs[c] - mesh.uvs[a]).norm() * tile_m,
                  (mesh.positions[c] - mesh.positions[a]).norm(), 1e-3);
    }
  }
}

/// A picture on a wall must not be mirrored: seen from outside, u runs right and v down.
TEST(AddQuad, ShowsItsPictureUprightFromOutside) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    TriangleMesh mesh;
    AddBox(&mesh, Random(seed).Pose(), {1, 2, 3}, BoxPaint::Whole(0));
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector2f uv1 = mesh.uvs[b] - mesh.uvs[a], uv2 = mesh.uvs[c] - mesh.uvs[a];
      // Counter-clockwise from outside with v downwards: a clockwise turn in (u, v).
      EXPECT_LT(uv1.x() * uv2.y() - uv1.y() * uv2.x(), 0) << seed;
    }
  }
}

TEST(AddCylinder, EnclosesThePrismOfItsSegmentsButForItsFoot) {
  for (const int segments : {3, 12, 20, 64}) {
    Random random(static_cast<unsigned>(segments));
    const float radius = random.In(0.1f, 1), height = random.In(0.2f, 2);
    TriangleMesh mesh;
    AddCylinder(&mesh, At(0, 0, 0, random.In(0, 6)), radius, height, segments, 0, {}, {});
    const double foot = 0.5 * segments * radius * radius * std::sin(2 * pi / segments);
    // The open foot lies in z = 0 and adds nothing to the sum.
    EXPECT_NEAR(VolumeOf(mesh), foot * height, 1e-4) << segments;
    EXPECT_TRUE(OpenArea(mesh).isApprox(Vector3f(0, 0, static_cast<float>(foot)), 1e-4f));
    ExpectNormalsOfTriangles(mesh, static_cast<float>(std::cos(pi / segments) - 1e-3));
  }
}

TEST(AddBar, RunsFromEndToEndInEveryDirection) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    const Vector3f from = random.Point(-2, 2), to = random.Point(-2, 2);
    const float thickness = random.In(0.02f, 0.2f);
    TriangleMesh mesh;
    AddBar(&mesh, from, to, thickness, 0);
    const float length = (to - from).norm();
    EXPECT_NEAR(VolumeOf(mesh), length * thickness * thickness, 1e-4) << seed;
    const Vector3f along = (to - from) / length;
    for (const Vector3f& p : mesh.positions) {
      const float at = along.dot(p - from);
      EXPECT_NEAR(std::min(std::abs(at), std::abs(at - length)), 0, 1e-4) << seed;
      EXPECT_NEAR((p - from - at * along).norm(), thickness / std::sqrt(2.0f), 1e-4) << seed;
    }
  }
}

TEST(AddMesh, MovesAPieceAndLeavesItsPaintAndWhatIsThere) {
  TriangleMesh piece, mesh;
  AddCylinder(&piece, At(0, 0, 0), 0.3f, 1, 8, 5, {}, {});
  AddBox(&mesh, At(0, 0, 0), {1, 1, 1}, BoxPaint::Whole(2));
  const TriangleMesh before = mesh;
  const Eigen::Isometry3f pose = Random(9).Pose();
  AddMesh(&mesh, pose, piece);
  const std::size_t vertices = before.positions.size(), triangles = before.triangles.size();
  ASSERT_EQ(mesh.positions.size(), vertices + piece.positions.size());
  ASSERT_EQ(mesh.triangles.size(), triangles + piece.triangles.size());
  EXPECT_TRUE(std::equal(before.positions.begin(), before.positions.end(), mesh.positions.begin()));
  for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
    EXPECT_EQ(mesh.materials[triangles + i], 5);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t to = mesh.triangles[triangles + i][k], from = piece.triangles[i][k];
      EXPECT_TRUE(mesh.positions[to].isApprox(pose * piece.positions[from], 1e-5f));
      EXPECT_TRUE(mesh.normals[to].isApprox(pose.linear() * piece.normals[from], 1e-5f));
      EXPECT_EQ(mesh.uvs[to], piece.uvs[from]);
    }
  }
}

}  // namespace
}  // namespace aisle::sim
