#pragma once

#include <cstdint>
#include <initializer_list>

namespace aisle::sim {

/// Random numbers by counting: the n-th number of a stream is a hash of (stream, n), so a stream
/// depends on what it is for and never on what was drawn before elsewhere.
class Dice {
 public:
  /// A stream named by the scene's seed and what the numbers are for.
  Dice(std::uint64_t seed, std::initializer_list<std::uint64_t> what) : key_(Mix(seed + 1)) {
    for (const std::uint64_t part : what) key_ = Mix(key_ ^ (part + 0x9E3779B97F4A7C15u));
  }

  /// Uniform in [0, 1).
  double Unit() { return static_cast<double>(Mix(key_ + count_++) >> 11) * 0x1p-53; }
  double Between(double low, double high) { return low + (high - low) * Unit(); }
  /// Uniform in [-1, 1).
  double Signed() { return 2 * Unit() - 1; }
  /// Uniform whole number in [0, count).
  int Pick(int count) { return static_cast<int>(Unit() * count); }
  bool Chance(double probability) { return Unit() < probability; }
  /// An independent stream; uses up one number of this one.
  Dice Fork() { return Dice(Mix(key_ + count_++), {}); }

  /// The finaliser of SplitMix64 (Steele, Lea, Flood, 2014): every input bit reaches every output.
  static std::uint64_t Mix(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
  }

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

}  // namespace aisle::sim
