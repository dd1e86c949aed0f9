#pragma once

#include <Eigen/Core>

#include "simulator/trace/hit_image.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// Velocity of the surface at hit `i` of an image in the world, m/s: interpolated from the
/// vertices' own; zero on the static world and where nothing was hit.
inline Eigen::Vector3f SurfaceVelocity(const World& world, const Snapshot& snapshot,
                                       const HitImage& image, std::size_t i) {
  const std::uint32_t geometry = image.geometry[i];
  if (geometry == 0 || geometry == kNoGeometry) return Eigen::Vector3f::Zero();
  const MoverState& mover = snapshot.movers[geometry - 1];
  const auto& [a, b, c] = world.mover_meshes()[geometry - 1].triangles[image.primitive[i]];
  const float u = image.u[i], v = image.v[i];
  return (1 - u - v) * mover.velocities[a] + u * mover.velocities[b] + v * mover.velocities[c];
}

}  // namespace aisle::sim
