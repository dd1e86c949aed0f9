#pragma once

#include <cstdint>

#include "simulator/common/mix.h"

namespace aisle::sim {

/// Random numbers of one path: the n-th depends on (seed, pixel, sample, n) alone. The first
/// sixteen are pairs of a Sobol sequence over the pixel's samples, Owen-scrambled and shuffled by
/// hashes (Burley, "Practical hash-based Owen scrambling", 2020), so that a pixel's paths spread
/// evenly; each number by itself is uniform, so nothing is biased.
class PathRandom {
 public:
  PathRandom() = default;
  PathRandom(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
      : pixel_(Mix(seed * kGolden + pixel)),
        state_(Mix(pixel_ + sample)),
        sample_(static_cast<std::uint32_t>(sample)) {}

  /// In [0, 1).
  float Next() {
    const std::uint32_t dimension = dimension_++;
    if (dimension >= kSpread) {
      state_ += kGolden;
      return static_cast<float>(Mix(state_) >> 40) * 0x1p-24f;
    }
    const auto pair = static_cast<std::uint32_t>(Mix(pixel_ + (dimension / 2 + 1) * kGolden));
    const std::uint32_t index = Scrambled(sample_, pair);
    const std::uint32_t point = dimension % 2 ? SecondSobol(index) : Reversed(index);
    const auto key = static_cast<std::uint32_t>(Mix(pixel_ ^ (dimension + 1) * kGolden));
    return static_cast<float>(Scrambled(point, key) >> 8) * 0x1p-24f;
  }

 private:
  static constexpr std::uint32_t kSpread = 16;
  static std::uint32_t Reversed(std::uint32_t x) {
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    return __builtin_bswap32(x);
  }
  /// Owen's nested scrambling of the binary digits, by a hash in which a bit depends on itself and
  /// those below it alone (Laine and Karras 2011), turned round.
  static std::uint32_t Scrambled(std::uint32_t x, std::uint32_t key) {
    x = Reversed(x) + key;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return Reversed(x);
  }
  static std::uint32_t SecondSobol(std::uint32_t index) {
    std::uint32_t point = 0;
    for (std::uint32_t v = 0x80000000u; index; index >>= 1, v ^= v >> 1) {
      if (index & 1) point ^= v;
    }
    return point;
  }

  std::uint64_t pixel_ = 0, state_ = 0;
  std::uint32_t sample_ = 0, dimension_ = 0;
};

}  // namespace aisle::sim
