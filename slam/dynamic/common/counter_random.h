#pragma once

#include <array>
#include <cstdint>

#include "slam/common/mix.h"

namespace aisle::slam::dynamic {

/// Random numbers as a pure function of where they are used: the same (seed, stream, counter) gives
/// the same number whatever was drawn before and on whatever thread. The mixing is splitmix64's.
class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, std::uint64_t stream) : key_(Mix(Mix(seed) ^ stream)) {}

  /// The next 64 bits of this stream.
  std::uint64_t Next() { return Mix(key_ + kGolden * ++counter_); }

  /// Uniform in [0, bound), bound > 0; the bias of 2^-32 per outcome is of no consequence here.
  int Below(int bound) {
    return static_cast<int>(((Next() >> 32) * static_cast<std::uint64_t>(bound)) >> 32);
  }

  /// N different indices in [0, bound), bound >= N, in order of drawing.
  template <std::size_t N>
  std::array<int, N> Distinct(int bound) {
    std::array<int, N> drawn{};
    for (std::size_t n = 0; n < N;) {
      drawn[n] = Below(bound);
      bool fresh = true;
      for (std::size_t k = 0; k < n; ++k) fresh = fresh && drawn[k] != drawn[n];
      n += fresh ? 1 : 0;
    }
    return drawn;
  }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace aisle::slam::dynamic
