#pragma once

#include <fmt/format.h>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// Whether a point of the floor is inside the hall, at least `margin` metres from its walls.
inline bool InHall(const HallSpec& hall, const Eigen::Vector2d& point, double margin) {
  return (point - hall.from).array().min((hall.to - point).array()).minCoeff() >= margin;
}

/// The hall in words, for messages.
inline std::string HallText(const HallSpec& hall) {
  return fmt::format("the hall, x {:g} to {:g} and y {:g} to {:g}", hall.from.x(), hall.to.x(),
                     hall.from.y(), hall.to.y());
}

}  // namespace aisle::sim
