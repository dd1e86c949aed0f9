#pragma once

#include <cstdint>
#include <limits>

namespace aisle::sim {

inline constexpr int kLanes = 8;  ///< rays a packet
inline constexpr std::uint32_t kNoGeometry = 0xffffffffu;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What a ray met: geometry 0 is the static world, 1 + i mover i, kNoGeometry nothing; primitive is
/// the triangle's index in that mesh; (u, v) its barycentrics: the point is
/// (1-u-v)·a + u·b + v·c; t is in units of the ray's direction.
struct Hit {
  float t = kInfinity;
  std::uint32_t geometry = kNoGeometry;
  std::uint32_t primitive = 0;
  float u = 0, v = 0;
};

/// Eight rays, points origin + t·direction with t in [t_near, t_far]; world frame. Directions need
/// not be unit length. A lane takes part where `valid` is -1 and is left alone where it is 0.
struct alignas(32) Rays8 {
  float ox[kLanes], oy[kLanes], oz[kLanes];
  float dx[kLanes], dy[kLanes], dz[kLanes];
  float t_near[kLanes], t_far[kLanes];
  std::int32_t valid[kLanes];
};

/// The hits of eight rays. Lanes that hit nothing have geometry kNoGeometry and t = infinity.
struct alignas(32) Hits8 {
  float t[kLanes];
  std::uint32_t geometry[kLanes], primitive[kLanes];
  float u[kLanes], v[kLanes];
};

}  // namespace aisle::sim
