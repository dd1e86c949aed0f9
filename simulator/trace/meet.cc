#include "simulator/trace/meet.h"

#include <algorithm>

namespace aisle::sim {

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
    meetings.u[k] = u;
    meetings.v[k] = v;
    meetings.inside[k] = std::min(std::min(u, v), 1 - u - v);
  }
  return meetings;
}

}  // namespace aisle::sim
