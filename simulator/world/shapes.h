#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "simulator/mesh/triangle_mesh.h"

namespace aisle::sim {

/// Appends a vertex; its index.
std::uint32_t AddVertex(TriangleMesh* mesh, const Eigen::Vector3f& position,
                        const Eigen::Vector3f& normal, const Eigen::Vector2f& uv);

/// Appends a triangle of vertices that are there, counter-clockwise from outside.
void AddTriangle(TriangleMesh* mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                 std::uint16_t material);

/// A rectangle of a texture: (0, 0) is its top left corner; beyond [0, 1] textures repeat.
struct UvRect {
  Eigen::Vector2f origin = Eigen::Vector2f::Zero();
  Eigen::Vector2f size = Eigen::Vector2f::Ones();
};

/// Appends a rectangle: `corner` is its top left as seen from outside, the normal is down × right.
void AddQuad(TriangleMesh* mesh, const Eigen::Vector3f& corner, const Eigen::Vector3f& right,
             const Eigen::Vector3f& down, const UvRect& uv, std::uint16_t material);

/// Faces of a box, in the order of AddBox's arrays.
enum BoxFace { kFront, kBack, kLeft, kRight, kTop, kBottom };  // +x, -x, +y, -y, +z, -z
inline constexpr unsigned kAllFaces = 63;
inline constexpr unsigned kNoBottom = 31;

/// What is painted on the faces of a box.
struct BoxPaint {
  std::uint16_t material = 0;
  std::array<UvRect, 6> uvs;
  unsigned faces = kAllFaces;  ///< bit i: face i is there

  /// Every face shows the whole rectangle.
  static BoxPaint Whole(std::uint16_t material, const UvRect& uv = {});
  /// Texture at its natural size: `tile_m` metres a repeat, shifted by `offset`.
  static BoxPaint Tiled(std::uint16_t material, const Eigen::Vector3f& size, float tile_m,
                        const Eigen::Vector2f& offset = Eigen::Vector2f::Zero());
};

/// Appends a box of a size about the origin of `pose`.
void AddBox(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const Eigen::Vector3f& size,
            const BoxPaint& paint);

/// The same between two corners in world axes.
void AddBox(TriangleMesh* mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
            const BoxPaint& paint);

/// Appends an upright cylinder standing on the origin of `pose`, smooth, its texture wrapped once;
/// `lid` is the texture of its top.
void AddCylinder(TriangleMesh* mesh, const Eigen::Isometry3f& pose, float radius, float height,
                 int segments, std::uint16_t material, const UvRect& side, const UvRect& lid);

/// A straight bar of rectangular section between two points.
void AddBar(TriangleMesh* mesh, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
            float thickness, std::uint16_t material);

/// Appends another mesh at a pose; materials stay what they are.
void AddMesh(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const TriangleMesh& piece);

/// Pose at (x, y, z) turned about z.
Eigen::Isometry3f At(float x, float y, float z, float heading_rad = 0);

}  // namespace aisle::sim
