#pragma once

#include <cstring>

#include "simulator/shade/lanes/wide.h"

namespace aisle::sim {

/// Eight rays from + t·to with t in [0, t_far], for the lanes where `valid` is -1.
inline Rays8 MakeRays(const F8x3& from, const F8x3& to, F8 t_far, I8 valid) {
  Rays8 rays;
  Store(from.x, rays.ox);
  Store(from.y, rays.oy);
  Store(from.z, rays.oz);
  Store(to.x, rays.dx);
  Store(to.y, rays.dy);
  Store(to.z, rays.dz);
  Store(Wide(0), rays.t_near);
  Store(t_far, rays.t_far);
  std::memcpy(rays.valid, &valid, sizeof(rays.valid));
  return rays;
}

}  // namespace aisle::sim
