#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// How a mezzanine stands on the floor; metres, world.
struct MezzanineFeet {
  static constexpr float kColumn_m = 0.16f;          ///< a column's side
  static constexpr float kStairHalfWidth_m = 0.45f;  ///< to the middle of its strings
  static constexpr float kTread_m = 0.26f;           ///< of the stair, along y

  std::vector<float> xs, ys;  ///< ascending; the middle of a column is at each (x, y)
  Eigen::Vector2f stair_top;  ///< the middle of its upper end: it leads down towards -y
  int stair_steps = 1;
  float stair_run_m() const { return static_cast<float>(stair_steps) * kTread_m; }
};

MezzanineFeet FeetOf(const MezzanineSpec& mezzanine);

/// Points from one end to the other that make so many equal parts.
std::vector<float> Evenly(float from, float to, int parts);
/// Likewise, in as few parts as are no longer than `pitch`.
std::vector<float> Divide(float from, float to, float pitch);

}  // namespace aisle::sim
