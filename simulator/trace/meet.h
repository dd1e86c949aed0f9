#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "simulator/trace/rays.h"

namespace aisle::sim {

/// Eight triangles by their corners; world frame, metres, one row an axis.
struct alignas(32) Corners8 {
  float a[3][kLanes], b[3][kLanes], c[3][kLanes];

  void Set(int lane, const Eigen::Vector3f& at_a, const Eigen::Vector3f& at_b,
           const Eigen::Vector3f& at_c) {
    for (int axis = 0; axis < 3; ++axis) {
      a[axis][lane] = at_a[axis];
      b[axis][lane] = at_b[axis];
      c[axis][lane] = at_c[axis];
    }
  }
  /// The same triangle in all lanes.
  void Fill(const Eigen::Vector3f& at_a, const Eigen::Vector3f& at_b, const Eigen::Vector3f& at_c) {
    for (int axis = 0; axis < 3; ++axis) {
      std::fill_n(a[axis], kLanes, at_a[axis]);
      std::fill_n(b[axis], kLanes, at_b[axis]);
      std::fill_n(c[axis], kLanes, at_c[axis]);
    }
  }
};

/// Where eight rays meet the planes of eight triangles: at t of the ray and at barycentrics (u, v)
/// of the triangle, as in Hit. `inside` is the least of u, v and 1-u-v.
struct alignas(32) Meetings8 {
  float t[kLanes], u[kLanes], v[kLanes], inside[kLanes];
};

/// Meets ray k with triangle k. Additions, multiplications and divisions alone, as IEEE 754 rounds
/// them, and so the same bits on every make of processor. Finite for any finite input: a ray along
/// the triangle's plane gets nonsense. Möller and Trumbore 1997.
Meetings8 Meet(const Rays8& rays, const Corners8& triangles);

}  // namespace aisle::sim
