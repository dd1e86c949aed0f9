#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace aisle::sim {

/// Where a recorded motion is on the floor, world: at its start and every step_s after it; at least
/// one place.
struct FloorWay {
  double step_s = 0.05;
  std::vector<Eigen::Vector2d> places;

  double duration_s() const { return step_s * static_cast<double>(places.size() - 1); }
  /// `since_s` after its start; it stands before that and after its end, straight in between.
  Eigen::Vector2d At(double since_s) const {
    const double steps = std::clamp(since_s, 0.0, duration_s()) / step_s;
    const std::size_t before = std::min(static_cast<std::size_t>(steps), places.size() - 1);
    const std::size_t after = std::min(before + 1, places.size() - 1);
    return places[before] +
           (steps - static_cast<double>(before)) * (places[after] - places[before]);
  }
};

/// Of those people of a scene who move as recorded, by their names.
using FloorWays = std::map<std::string, FloorWay>;

}  // namespace aisle::sim
