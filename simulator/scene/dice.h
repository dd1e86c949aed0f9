#pragma once

#include <cstdint>
#include <initializer_list>

#include "simulator/common/mix.h"

namespace aisle::sim {

/// Random numbers by counting: the n-th number of a stream is a hash of (stream, n), so a stream
/// depends on what it is for and never on what was drawn before elsewhere.
class Dice {
 public:
  /// A stream named by the scene's seed and what the numbers are for.
  Dice(std::uint64_t seed, std::initializer_list<std::uint64_t> what)
      : key_(Mix(kGolden + seed + 1)) {
    for (const std::uint64_t part : what) key_ = Mix(kGolden + (key_ ^ (part + kGolden)));
  }

  /// Uniform in [0, 1).
  double Unit() { return static_cast<double>(Mix(kGolden + key_ + count_++) >> 11) * 0x1p-53; }
  double Between(double low, double high) { return low + (high - low) * Unit(); }
  /// Uniform in [-1, 1).
  double Signed() { return 2 * Unit() - 1; }
  /// Uniform whole number in [0, count).
  int Pick(int count) { return static_cast<int>(Unit() * count); }
  bool Chance(double probability) { return Unit() < probability; }
  /// An independent stream; uses up one number of this one.
  Dice Fork() { return Dice(Mix(kGolden + key_ + count_++), {}); }

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

}  // namespace aisle::sim
