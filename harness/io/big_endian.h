#pragma once

#include <cstdint>

namespace aisle {

/// The number that at most four bytes make up, the most significant first: of char or std::uint8_t.
template <class Bytes>
std::uint32_t BigEndian(const Bytes& bytes) {
  std::uint32_t value = 0;
  for (const auto byte : bytes) value = value << 8 | static_cast<std::uint8_t>(byte);
  return value;
}

}  // namespace aisle
