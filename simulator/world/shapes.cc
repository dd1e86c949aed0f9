#include "simulator/world/shapes.h"

#include <cmath>
#include <numbers>

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

struct FaceAxes {
  Vector3f normal, right, down;
};

/// Seen from outside with z up (the top with y up).
const std::array<FaceAxes, 6>& Faces() {
  static const Vector3f x = Vector3f::UnitX(), y = Vector3f::UnitY(), z = Vector3f::UnitZ();
  static const std::array<FaceAxes, 6> faces = {
      {{x, y, -z}, {-x, -y, -z}, {y, -x, -z}, {-y, x, -z}, {z, x, -y}, {-z, x, y}}};
  return faces;
}

}  // namespace

std::uint32_t AddVertex(TriangleMesh* mesh, const Vector3f& position, const Vector3f& normal,
                        const Vector2f& uv) {
  mesh->positions.push_back(position);
  mesh->normals.push_back(normal);
  mesh->uvs.push_back(uv);
  return static_cast<std::uint32_t>(mesh->positions.size() - 1);
}

void AddTriangle(TriangleMesh* mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                 std::uint16_t material) {
  mesh->triangles.push_back({a, b, c});
  mesh->materials.push_back(material);
}

void AddQuad(TriangleMesh* mesh, const Vector3f& corner, const Vector3f& right,
             const Vector3f& down, const UvRect& uv, std::uint16_t material) {
  const Vector3f normal = down.cross(right).normalized();
  const auto vertex = [&](float u, float v) {
    return AddVertex(mesh, corner + u * right + v * down, normal,
                     uv.origin + uv.size.cwiseProduct(Vector2f(u, v)));
  };
  const std::uint32_t a = vertex(0, 0), b = vertex(0, 1), c = vertex(1, 1), d = vertex(1, 0);
  AddTriangle(mesh, a, b, c, material);
  AddTriangle(mesh, a, c, d, material);
}

BoxPaint BoxPaint::Whole(std::uint16_t material, const UvRect& uv) {
  BoxPaint paint;
  paint.material = material;
  paint.uvs.fill(uv);
  return paint;
}

BoxPaint BoxPaint::Tiled(std::uint16_t material, const Vector3f& size, float tile_m,
                         const Vector2f& offset) {
  BoxPaint paint;
  paint.material = material;
  for (std::size_t i = 0; i < 6; ++i) {
    const FaceAxes& axes = Faces()[i];
    paint.uvs[i] = {
        offset + Vector2f(0.37f, 0.61f) * static_cast<float>(i),
        Vector2f(std::abs(axes.right.dot(size)), std::abs(axes.down.dot(size))) / tile_m};
  }
  return paint;
}

void AddBox(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const Vector3f& size,
            const BoxPaint& paint) {
  for (std::size_t i = 0; i < 6; ++i) {
    if ((paint.faces >> i & 1u) == 0) continue;
    const FaceAxes& axes = Faces()[i];
    const Vector3f right = axes.right * std::abs(axes.right.dot(size));
    const Vector3f down = axes.down * std::abs(axes.down.dot(size));
    const Vector3f corner =
        axes.normal * std::abs(axes.normal.dot(size)) / 2 - right / 2 - down / 2;
    AddQuad(mesh, pose * corner, pose.linear() * right, pose.linear() * down, paint.uvs[i],
            paint.material);
  }
}

void AddBox(TriangleMesh* mesh, const Vector3f& low, const Vector3f& high, const BoxPaint& paint) {
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.translation() = (low + high) / 2;
  AddBox(mesh, pose, high - low, paint);
}

void AddCylinder(TriangleMesh* mesh, const Eigen::Isometry3f& pose, float radius, float height,
                 int segments, std::uint16_t material, const UvRect& side, const UvRect& lid) {
  const auto ring = [&](int i) {
    const float angle =
        2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(segments);
    return Vector2f(std::cos(angle), std::sin(angle));
  };
  const std::uint32_t middle =
      AddVertex(mesh, pose * Vector3f(0, 0, height), pose.linear() * Vector3f::UnitZ(),
                lid.origin + lid.size / 2);
  for (int i = 0; i < segments; ++i) {
    std::array<std::uint32_t, 6> v{};
    for (int k = 0; k < 2; ++k) {
      const Vector2f at = ring(i + k);
      const Vector3f normal = pose.linear() * Vector3f(at.x(), at.y(), 0);
      const float u = static_cast<float>(i + k) / static_cast<float>(segments);
      const std::size_t slot = static_cast<std::size_t>(k);
      const auto uv = [&](float w) -> Vector2f {
        return side.origin + side.size.cwiseProduct(Vector2f(u, w));
      };
      const Vector3f foot(radius * at.x(), radius * at.y(), 0);
      const Vector3f top(foot.x(), foot.y(), height);
      v[slot] = AddVertex(mesh, pose * top, normal, uv(0));
      v[slot + 2] = AddVertex(mesh, pose * foot, normal, uv(1));
      v[slot + 4] = AddVertex(
          mesh, pose * top, pose.linear() * Vector3f::UnitZ(),
          lid.origin + lid.size.cwiseProduct(Vector2f(0.5f + at.x() / 2, 0.5f - at.y() / 2)));
    }
    AddTriangle(mesh, v[0], v[2], v[3], material);
    AddTriangle(mesh, v[0], v[3], v[1], material);
    AddTriangle(mesh, middle, v[4], v[5], material);
  }
}

void AddBar(TriangleMesh* mesh, const Vector3f& from, const Vector3f& to, float thickness,
            std::uint16_t material) {
  const Vector3f along = to - from;
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.translation() = (from + to) / 2;
  pose.linear() = Eigen::Quaternionf::FromTwoVectors(Vector3f::UnitX(), along).toRotationMatrix();
  const Vector3f size(along.norm(), thickness, thickness);
  AddBox(mesh, pose, size, BoxPaint::Tiled(material, size, 0.5f));
}

Eigen::Isometry3f At(float x, float y, float z, float heading_rad) {
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.translation() = Vector3f(x, y, z);
  pose.linear() = Eigen::AngleAxisf(heading_rad, Vector3f::UnitZ()).toRotationMatrix();
  return pose;
}

void AddMesh(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const TriangleMesh& piece) {
  const auto first = static_cast<std::uint32_t>(mesh->positions.size());
  for (const Eigen::Vector3f& position : piece.positions) {
    mesh->positions.push_back(pose * position);
  }
  for (const Eigen::Vector3f& normal : piece.normals) {
    mesh->normals.push_back(pose.linear() * normal);
  }
  mesh->uvs.insert(mesh->uvs.end(), piece.uvs.begin(), piece.uvs.end());
  for (const auto& [a, b, c] : piece.triangles) {
    mesh->triangles.push_back({a + first, b + first, c + first});
  }
  mesh->materials.insert(mesh->materials.end(), piece.materials.begin(), piece.materials.end());
}

}  // namespace aisle::sim
