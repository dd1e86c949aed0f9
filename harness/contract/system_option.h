#pragma once

#include <string>
#include <vector>

namespace aisle {

/// One option of a built-in system, as users name, set and read it.
struct SystemOption {
  enum class Kind { kNumber, kInteger, kFlag, kChoice, kText };
  std::string path;  ///< "dynamic.robust.field.memory"
  Kind kind = Kind::kNumber;
  std::string value;                 ///< of the system that was asked about
  std::string unit;                  ///< "px", "m", "frames", …; empty: none
  std::string help;                  ///< one sentence
  double low = 0, high = 0;          ///< of numbers and integers, both allowed
  std::vector<std::string> choices;  ///< of kChoice
};

}  // namespace aisle
