#pragma once

#include <map>
#include <optional>
#include <string>

namespace aisle {

/// A number that travels with its meaning, or the reason why there is none.
struct Score {
  std::optional<double> value;
  std::string unit;        ///< "m", "deg", "1", "ms", "%", …
  std::string alignment;   ///< "se3", "none", …; empty where it has no meaning
  std::size_t n = 0;       ///< samples behind the value
  std::string absent;      ///< why there is no value; empty otherwise
  std::string basis = {};  ///< what it was computed from, where that is not what its name says
};
using Scorecard = std::map<std::string, Score>;  ///< by score name

}  // namespace aisle
