#include "simulator/trace/meet.h"

#include <algorithm>

namespace aisle::sim {

Corners8::Corners8(const Corners& one) {
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(a[axis], kLanes, one.a[axis]);
    std::fill_n(b[axis], kLanes, one.b[axis]);
    std::fill_n(c[axis], kLanes, one.c[axis]);
  }
  std::fill_n(rim, kLanes, one.rim);
}

Corners8::Corners8(const std::array<const Corners*, kLanes>& by_lane) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Corners& one = *by_lane[k];
    for (int axis = 0; axis < 3; ++axis) {
      a[axis][k] = one.a[axis];
      b[axis][k] = one.b[axis];
      c[axis][k] = one.c[axis];
    }
    rim[k] = one.rim;
  }
}

Meetings8 Meet(const Rays8& rays, const Corners8& triangles) {
  Meetings8 meetings;
  for (int k = 0; k < kLanes; ++k) {
    const float ax = triangles.a[0][k], ay = triangles.a[1][k], az = triangles.a[2][k];
    const float abx = triangles.b[0][k] - ax, aby = triangles.b[1][k] - ay,
                abz = triangles.b[2][k] - az;
    const float acx = triangles.c[0][k] - ax, acy = triangles.c[1][k] - ay,
                acz = triangles.c[2][k] - az;
    const float nx = aby * acz - abz * acy, ny = abz * acx - abx * acz, nz = abx * acy - aby * acx;
    const float sx = ax - rays.ox[k], sy = ay - rays.oy[k], sz = az - rays.oz[k];
    const float dx = rays.dx[k], dy = rays.dy[k], dz = rays.dz[k];
    const float rx = sy * dz - sz * dy, ry = sz * dx - sx * dz, rz = sx * dy - sy * dx;
    const float slope = nx * dx + ny * dy + nz * dz;
    const float along = slope == 0 ? 1 : slope;
    const float u = (acx * rx + acy * ry + acz * rz) / along;
    const float v = -(abx * rx + aby * ry + abz * rz) / along;
    meetings.t[k] = (nx * sx + ny * sy + nz * sz) / along;
    meetings.on_rim[k] = std::min(std::min(u, v), 1 - u - v) < triangles.rim[k] ? -1 : 0;
    const float inside_u = std::min(std::max(u, 0.0f), 1.0f);
    meetings.u[k] = inside_u;
    meetings.v[k] = std::min(std::max(v, 0.0f), 1 - inside_u);
  }
  return meetings;
}

}  // namespace aisle::sim
