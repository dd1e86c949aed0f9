#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace aisle::sim {

/// Triangles with what shading needs at a hit. All per-vertex arrays have one entry per position.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> positions;               ///< metres, in the frame the owner states
  std::vector<Eigen::Vector3f> normals;                 ///< unit length, same frame
  std::vector<Eigen::Vector2f> uvs;                     ///< texture coordinates, (0,0) = top left
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices, counter-clockwise from outside
  std::vector<std::uint16_t> materials;  ///< per triangle: index into the owner's materials
};

}  // namespace aisle::sim
