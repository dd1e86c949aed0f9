#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

namespace aisle::slam {

/// FNV-1a (Fowler, Noll, Vo): tells a damaged file from a whole one.
class Fnv1a {
 public:
  void Add(std::uint64_t value) { hash_ = (hash_ ^ value) * 0x100000001b3ULL; }
  /// Brings the upper bits down. The multiplication alone carries them up: the top byte of a word
  /// would reach no other bit.
  void Fold() { hash_ ^= hash_ >> 29; }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// Over single bytes.
inline std::uint64_t ChecksumOfBytes(std::string_view bytes) {
  Fnv1a sum;
  for (const char byte : bytes) sum.Add(static_cast<unsigned char>(byte));
  return sum.hash();
}

/// Over words of eight bytes, then over the bytes that are left: for large files.
inline std::uint64_t ChecksumOfWords(std::string_view bytes) {
  Fnv1a sum;
  const auto add = [&sum](std::uint64_t word) {
    sum.Add(word);
    sum.Fold();
  };
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, 8);
    add(word);
  }
  for (; i < bytes.size(); ++i) add(static_cast<unsigned char>(bytes[i]));
  return sum.hash();
}

}  // namespace aisle::slam
