#pragma once

#include <array>
#include <optional>

#include "simulator/scene/kinds.h"
#include "simulator/scene/mark.h"

namespace aisle::sim {

/// People who walk to and fro in a part of the hall and keep out of each other's way. At the level
/// low a third of them is there, at mid two thirds, at high all.
struct CrowdSpec {
  Mark mark;
  int people = 0;
  std::optional<std::array<double, 4>> in;           ///< x0, y0, x1, y1; absent: the hall
  std::optional<std::array<int, 2>> between_racks;   ///< the aisle between two rows instead
  double speed_mps = 1.34, speed_spread_mps = 0.26;  ///< of free walking (Helbing and Molnar 1995)
  double pause_s = 2;                                ///< longest rest at a goal
  double distance_m = 0.6;                           ///< middle to middle, at least
};

}  // namespace aisle::sim
