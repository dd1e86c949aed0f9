#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace aisle {

/// "1 run", "2 runs", of a noun whose plural is its s.
inline std::string Counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace aisle
