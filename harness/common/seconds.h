#pragma once

#include <cstdint>

namespace aisle {

/// Of a stamp or a span in nanoseconds.
inline double ToSeconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

}  // namespace aisle
