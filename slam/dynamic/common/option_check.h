#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace aisle::slam::dynamic {

/// A broken rule in words; empty: all is well.
using OptionError = std::string;

/// Empty if low <= value <= high, else a sentence with name, value and bounds.
template <typename T>
OptionError CheckRange(std::string_view name, T value, T low, T high) {
  if (value >= low && value <= high) return {};
  return fmt::format("{} is {}; it must lie in [{}, {}]", name, value, low, high);
}

/// The first of several checks that found something.
template <typename... Errors>
OptionError FirstOf(const Errors&... errors) {
  OptionError first;
  ((first = first.empty() ? errors : first), ...);
  return first;
}

}  // namespace aisle::slam::dynamic
