#pragma once

#include <numbers>

namespace aisle::sim {

inline constexpr double kDegree = std::numbers::pi / 180;  ///< radians

}  // namespace aisle::sim
