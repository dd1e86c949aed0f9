#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace aisle::slam {

/// 256 brightness comparisons around a keypoint, in a frame turned with it.
using Descriptor = std::array<std::uint64_t, 4>;

/// Bits that differ, 0 to 256.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  return std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]) + std::popcount(a[2] ^ b[2]) +
         std::popcount(a[3] ^ b[3]);
}

}  // namespace aisle::slam
