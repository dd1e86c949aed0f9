#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace aisle::sim {

/// What stands between spaces, tabs and line ends.
std::vector<std::string_view> WordsOf(std::string_view line);

/// A finite decimal number that is all of the text ("1", "-.5", "+2.", "1e-3"), or nothing.
std::optional<double> DecimalOf(std::string_view text);

/// Seconds as whole nanoseconds, rounded half away from zero, digit by digit: a double near 1.6e9
/// holds no nanoseconds. All of the text, as DecimalOf takes it, exponents included. Nothing where
/// it is no number or beyond 4e9 s either way, so that any two have a difference.
std::optional<std::int64_t> NanosecondsOf(std::string_view seconds);

}  // namespace aisle::sim
