#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

namespace aisle::slam::dynamic {

/// A broken rule in words, or nothing.
using OptionError = std::optional<std::string>;

/// Nothing if low <= value <= high, else a sentence with name, value and bounds.
template <typename T>
OptionError CheckRange(std::string_view name, T value, T low, T high) {
  if (value >= low && value <= high) return std::nullopt;
  return fmt::format("{} is {}; it must lie in [{}, {}]", name, value, low, high);
}

/// The first of several checks that found something.
template <typename... Errors>
OptionError FirstOf(const Errors&... errors) {
  OptionError first;
  ((first = first ? first : errors), ...);
  return first;
}

}  // namespace aisle::slam::dynamic
