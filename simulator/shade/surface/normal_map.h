#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "simulator/mesh/material.h"
#include "simulator/mesh/triangle_mesh.h"
#include "simulator/shade/surface/texture_pool.h"

namespace aisle::sim {

/// A place on a posed mesh: barycentrics (u, v) of a triangle.
struct MeshPlace {
  const TriangleMesh& topology;
  std::span<const Eigen::Vector3f> positions, normals;  ///< as posed, world
  std::uint32_t triangle;
  float u, v;
};

/// The interpolated vertex normal there, unit.
Eigen::Vector3f SmoothNormal(const MeshPlace& place);

/// The axes of a normal map at a place, unit, and where it is read there.
struct MapAxes {
  Eigen::Vector3f smooth;         ///< its z, the surface's own
  Eigen::Vector3f right, upward;  ///< its x and y
  MapPoint point;
};

/// None where the material has no normal map, or the triangle no extent on it. `width_m` is the
/// footprint.
std::optional<MapAxes> AxesOfMap(const MeshPlace& place, const Material& material, float width_m);

/// The normal that a map's x and y make there: its z follows from these, and then, as in glTF 2.0,
/// x and y are scaled and all is made a unit.
Eigen::Vector3f BentNormal(const MapAxes& axes, const Eigen::Vector2f& bend, float scale);

/// The smooth normal, bent by the material's normal map if it has one, averaged over a footprint
/// `width_m` wide. As in glTF 2.0 the map's x points along growing u, its y against growing v (up
/// in the picture), its z along the normal; the tangents are the triangle's own.
Eigen::Vector3f MappedNormal(const MeshPlace& place, const Material& material,
                             const TexturePool& textures, float width_m);

}  // namespace aisle::sim
