#pragma once

#include <Eigen/Core>
#include <span>

#include "simulator/trace/hit_image.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// Velocity in the world of the point (u, v) of triangle `primitive` of a mover's mesh, m/s:
/// interpolated from the vertices' own.
inline Eigen::Vector3f VelocityOnMover(const TriangleMesh& mesh,
                                       std::span<const Eigen::Vector3f> velocities,
                                       std::uint32_t primitive, float u, float v) {
  const auto& [a, b, c] = mesh.triangles[primitive];
  return (1 - u - v) * velocities[a] + u * velocities[b] + v * velocities[c];
}

/// Velocity of the surface at hit `i` of an image in the world, m/s; zero on the static world and
/// where nothing was hit.
inline Eigen::Vector3f SurfaceVelocity(const World& world, const Snapshot& snapshot,
                                       const HitImage& image, std::size_t i) {
  const std::uint32_t geometry = image.geometry[i];
  if (geometry == 0 || geometry == kNoGeometry) return Eigen::Vector3f::Zero();
  return VelocityOnMover(world.mover_meshes()[geometry - 1],
                         snapshot.movers[geometry - 1].velocities, image.primitive[i], image.u[i],
                         image.v[i]);
}

}  // namespace aisle::sim
