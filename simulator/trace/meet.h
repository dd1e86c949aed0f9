#pragma once

#include <Eigen/Core>
#include <array>

#include "simulator/trace/rays.h"

namespace aisle::sim {

/// A triangle by its corners, world frame, metres; `rim` is how far its rim reaches in: see
/// Meetings8.
struct Corners {
  Eigen::Vector3f a = Eigen::Vector3f::Zero(), b = Eigen::Vector3f::Zero(),
                  c = Eigen::Vector3f::Zero();
  float rim = 0;
};

/// Eight triangles, one row an axis.
struct alignas(32) Corners8 {
  float a[3][kLanes], b[3][kLanes], c[3][kLanes];
  float rim[kLanes];

  explicit Corners8(const Corners& in_all_lanes);
  explicit Corners8(const std::array<const Corners*, kLanes>& by_lane);
  Corners8(const Corners& in_first_four, const Corners& in_last_four);
};

/// Where eight rays meet the planes of eight triangles: at t of the ray and at barycentrics (u, v)
/// of the triangle, as in Hit, drawn onto it where they lie outside. `on_rim` is -1 where the least
/// of u, v and 1-u-v is below the triangle's rim, else 0.
struct alignas(32) Meetings8 {
  float t[kLanes], u[kLanes], v[kLanes];
  std::int32_t on_rim[kLanes];
};

/// Meets ray k with triangle k. Additions, multiplications and divisions alone, as IEEE 754 rounds
/// them, and so the same bits on every make of processor. Finite for any finite input: a ray along
/// the triangle's plane gets nonsense. Möller and Trumbore 1997.
Meetings8 Meet(const Rays8& rays, const Corners8& triangles);

}  // namespace aisle::sim
