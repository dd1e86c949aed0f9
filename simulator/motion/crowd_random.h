#pragma once

#include <cmath>
#include <cstdint>

#include "simulator/common/mix.h"

namespace aisle::sim {

/// Random numbers of a crowd, by counting through SplitMix64's finaliser (Steele, Lea, Flood 2014).
class CrowdRandom {
 public:
  CrowdRandom(std::uint64_t seed, std::uint64_t attempt)
      : state_(Mix(seed * kGolden + 0x63726f7764) ^ Mix(attempt + kGolden)) {}

  /// Uniform in [0, 1).
  double Unit() {
    state_ += kGolden;
    return static_cast<double>(Mix(state_) >> 11) * 0x1p-53;
  }
  /// About normal with deviation 1, never beyond 3.5: the sum of twelve uniform numbers.
  double Normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += Unit();
    return std::fmin(std::fmax(sum, -3.5), 3.5);
  }

 private:
  std::uint64_t state_;
};

}  // namespace aisle::sim
