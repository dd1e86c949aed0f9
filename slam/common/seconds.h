#pragma once

#include <cstdint>

namespace aisle::slam {

/// Between two stamps; negative where the second is the earlier one.
inline double SecondsBetween(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) * 1e-9;
}

}  // namespace aisle::slam
