#include "simulator/trace/meet.h"

#include <immintrin.h>

#include <algorithm>
#include <cstddef>

namespace aisle::sim {

Corners8::Corners8(const Corners& one) {
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(a[axis], kLanes, one.a[axis]);
    std::fill_n(b[axis], kLanes, one.b[axis]);
    std::fill_n(c[axis], kLanes, one.c[axis]);
  }
  std::fill_n(rim, kLanes, one.rim);
}

// Eight corners of eight floats are turned over in registers: rows that are written lane by lane
// and then read whole have to wait for the memory.
Corners8::Corners8(const std::array<const Corners*, kLanes>& by_lane) {
  static_assert(offsetof(Corners, rim) == 9 * sizeof(float));
  const auto from = [&](std::size_t lane) { return by_lane[lane]->a.data(); };
  __m256 pairs[kLanes], fours[kLanes];
  for (std::size_t k = 0; k < kLanes; k += 2) {
    const __m256 first = _mm256_loadu_ps(from(k)), second = _mm256_loadu_ps(from(k + 1));
    pairs[k] = _mm256_unpacklo_ps(first, second);
    pairs[k + 1] = _mm256_unpackhi_ps(first, second);
  }
  for (std::size_t k = 0; k < kLanes; k += 4) {
    for (std::size_t half = 0; half < 2; ++half) {
      const __m256 first = pairs[k + half], second = pairs[k + 2 + half];
      fours[k + 2 * half] = _mm256_shuffle_ps(first, second, _MM_SHUFFLE(1, 0, 1, 0));
      fours[k + 2 * half + 1] = _mm256_shuffle_ps(first, second, _MM_SHUFFLE(3, 2, 3, 2));
    }
  }
  const std::array<float*, kLanes> rows = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1]};
  for (std::size_t k = 0; k < 4; ++k) {
    _mm256_store_ps(rows[k], _mm256_permute2f128_ps(fours[k], fours[k + 4], 0x20));
    _mm256_store_ps(rows[k + 4], _mm256_permute2f128_ps(fours[k], fours[k + 4], 0x31));
  }
  const auto row = [&](std::size_t i) {
    return _mm256_setr_ps(from(0)[i], from(1)[i], from(2)[i], from(3)[i], from(4)[i], from(5)[i],
                          from(6)[i], from(7)[i]);
  };
  _mm256_store_ps(c[2], row(8));
  _mm256_store_ps(rim, row(9));
}

Corners8::Corners8(const Corners& first, const Corners& last) {
  const auto fill = [](float in_first_four, float in_last_four, float* row) {
    _mm256_store_ps(row, _mm256_set_m128(_mm_set1_ps(in_last_four), _mm_set1_ps(in_first_four)));
  };
  for (int axis = 0; axis < 3; ++axis) {
    fill(first.a[axis], last.a[axis], a[axis]);
    fill(first.b[axis], last.b[axis], b[axis]);
    fill(first.c[axis], last.c[axis], c[axis]);
  }
  fill(first.rim, last.rim, rim);
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
