#pragma once

#include <bit>
#include <cstdint>

namespace aisle::slam::dynamic {

/// Natural logarithm to 1e-6 of a positive normal number. Plain arithmetic: loops with it are
/// vectorised, and its bits do not depend on the C library.
inline float FastLog(float a) {
  constexpr std::int32_t kRootOfHalf = 0x3f3504f3;  // the bits of sqrt(1/2)
  constexpr float kLog2 = 0.693147181F;
  const auto bits = std::bit_cast<std::int32_t>(a);
  const std::int32_t exponent = (bits - kRootOfHalf) >> 23;
  const float m = std::bit_cast<float>(bits - (exponent << 23));  // in [sqrt(1/2), sqrt(2))
  const float s = (m - 1) / (m + 1), s2 = s * s;                  // log m = 2 artanh s
  const float series = 1 + s2 * (1.0F / 3 + s2 * (1.0F / 5 + s2 * (1.0F / 7 + s2 * (1.0F / 9))));
  return static_cast<float>(exponent) * kLog2 + 2 * s * series;
}

}  // namespace aisle::slam::dynamic
