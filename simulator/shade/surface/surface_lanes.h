#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/surface/surface_table.h"
#include "simulator/shade/surface/texture_pool.h"

namespace aisle::sim {

/// A family of surfaces as the lanes read it: records and light by slot. The static world is one,
/// all movers of a frame together are another.
struct Surfaces {
  const SurfaceRecord* records = nullptr;
  const float* light = nullptr;  ///< irradiance by slot
};

/// Eight hits seen from one camera. `dx…` is the ray's direction (z = 1 in the camera, so that t is
/// the depth), `record` the index of the triangle's record.
struct HitLanes {
  F8 t, u, v;
  F8 dx, dy, dz;
  I8 record;
};

/// How the ray's direction changes from one pixel to the next, world.
struct RayStep {
  Eigen::Vector3f right, down;
};

/// What eight pixels see: radiance = reflectance · irradiance / π.
struct SurfaceLanes {
  F8 reflectance, irradiance;
};

/// Looks up light and texture for eight hits, the texture averaged over each pixel's footprint.
SurfaceLanes LookUp(const Surfaces& surfaces, const TexturePool& textures, const HitLanes& hits,
                    const RayStep& step);

}  // namespace aisle::sim
