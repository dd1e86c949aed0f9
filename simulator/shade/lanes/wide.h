#pragma once

#include <immintrin.h>

#include <cstdint>

#include "simulator/trace/rays.h"

namespace aisle::sim {

/// Eight floats or ints in one register; arithmetic and comparisons work lane by lane, and a
/// comparison gives -1 or 0 in each lane of an I8.
typedef float F8 __attribute__((vector_size(32)));
typedef std::int32_t I8 __attribute__((vector_size(32)));

/// A move, not an addition: the bits may be an integer's, and a thread that flushes denormal
/// numbers to zero would lose it.
inline F8 Wide(float value) { return reinterpret_cast<F8>(_mm256_set1_ps(value)); }
inline I8 WideInt(std::int32_t value) { return I8{} + value; }
inline F8 LoadF(const float* from) { return reinterpret_cast<F8>(_mm256_loadu_ps(from)); }
inline I8 LoadI(const void* from) {
  return reinterpret_cast<I8>(_mm256_loadu_si256(static_cast<const __m256i*>(from)));
}
inline void Store(F8 value, float* to) { _mm256_storeu_ps(to, reinterpret_cast<__m256>(value)); }
inline void StoreI(I8 value, void* to) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), reinterpret_cast<__m256i>(value));
}
inline bool Any(I8 mask) { return _mm256_movemask_ps(reinterpret_cast<__m256>(mask)) != 0; }
/// Bit k is set where lane k of a comparison is.
inline unsigned Bits(I8 mask) {
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
}
inline F8 Select(I8 mask, F8 yes, F8 no) { return mask ? yes : no; }
inline F8 Sqrt(F8 x) { return reinterpret_cast<F8>(_mm256_sqrt_ps(reinterpret_cast<__m256>(x))); }
inline F8 Min(F8 a, F8 b) { return a < b ? a : b; }
inline F8 Max(F8 a, F8 b) { return a > b ? a : b; }
inline F8 Abs(F8 x) { return Max(x, -x); }
inline F8 Floor(F8 x) { return reinterpret_cast<F8>(_mm256_floor_ps(reinterpret_cast<__m256>(x))); }
inline F8 Ceil(F8 x) { return reinterpret_cast<F8>(_mm256_ceil_ps(reinterpret_cast<__m256>(x))); }
/// Towards zero.
inline I8 ToInt(F8 x) {
  return reinterpret_cast<I8>(_mm256_cvttps_epi32(reinterpret_cast<__m256>(x)));
}
inline F8 ToFloat(I8 x) {
  return reinterpret_cast<F8>(_mm256_cvtepi32_ps(reinterpret_cast<__m256i>(x)));
}
inline I8 ShiftLeft(I8 x, I8 count) { return x << count; }
inline I8 MinInt(I8 a, I8 b) { return a < b ? a : b; }
inline I8 MaxInt(I8 a, I8 b) { return a > b ? a : b; }

inline F8 Gather(const float* base, I8 index) {
  return reinterpret_cast<F8>(_mm256_i32gather_ps(base, reinterpret_cast<__m256i>(index), 4));
}
inline I8 GatherInt(const std::int32_t* base, I8 index) {
  return reinterpret_cast<I8>(_mm256_i32gather_epi32(base, reinterpret_cast<__m256i>(index), 4));
}
/// Lane by lane from the first on.
inline float Sum(F8 lanes) {
  float sum = 0;
  for (int k = 0; k < 8; ++k) sum += lanes[k];
  return sum;
}
/// Eight bytes, each a lane from 0 to 255.
inline I8 LoadBytes(const std::uint8_t* from) {
  return reinterpret_cast<I8>(
      _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
}
/// Four bytes from each byte offset; the table must have three bytes to spare at its end.
inline I8 GatherBytes(const std::uint8_t* base, I8 offset) {
  return reinterpret_cast<I8>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(base),
                                                     reinterpret_cast<__m256i>(offset), 1));
}

/// The lanes whose bit is set.
inline I8 LanesOf(unsigned bits) {
  const I8 lane = {1, 2, 4, 8, 16, 32, 64, 128};
  return (WideInt(static_cast<std::int32_t>(bits)) & lane) != 0;
}

/// A vector of one lane (float) or of eight (F8).
template <typename T>
struct Triple {
  T x, y, z;
};
using F8x3 = Triple<F8>;
inline F8x3 Wide3(const Eigen::Vector3f& v) { return {Wide(v.x()), Wide(v.y()), Wide(v.z())}; }
template <typename T>
T Dot(const Triple<T>& a, const Triple<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline F8x3 Minus(const F8x3& a, const F8x3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

/// log2, to 0.01 for x > 0: the exponent plus a parabola through the mantissa.
inline F8 FastLog2(F8 x) {
  const I8 bits = reinterpret_cast<I8>(x);
  const F8 exponent = ToFloat(((bits >> 23) & 255) - 128);
  const F8 m = reinterpret_cast<F8>((bits & 0x007fffff) | 0x3f800000);
  return exponent + (m * (2.0f - m * (1.0f / 3.0f)) - 2.0f / 3.0f);
}

}  // namespace aisle::sim
