#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <string>

namespace aisle {

/// "a, b and 3 more": all of the words where they are three at most, else the first two.
inline std::string FirstOfMany(std::span<const std::string> words, const char* separator) {
  constexpr std::size_t kMostNamed = 3, kFirst = 2;
  if (words.size() <= kMostNamed) return fmt::format("{}", fmt::join(words, separator));
  return fmt::format("{} and {} more", fmt::join(words.first(kFirst), separator),
                     words.size() - kFirst);
}

}  // namespace aisle
