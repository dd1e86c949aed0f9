#pragma once

#include <array>

#include "simulator/scene/scene.h"
#include "simulator/world/shapes.h"

namespace aisle::sim {

/// One wall seen from inside: `corner` is its left end on the floor, `along` points right.
struct Wall {
  Eigen::Vector3f corner, along, inward;
  float length = 0;

  /// A point of the wall: metres to the right, up, and into the hall.
  Eigen::Vector3f At(float right, float up, float in) const {
    return corner + right * along + up * Eigen::Vector3f::UnitZ() + in * inward;
  }
  /// Frame at a point: x into the hall, y to the left seen from inside.
  Eigen::Isometry3f Frame(float right, float up, float in) const {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.linear().col(0) = inward;
    pose.linear().col(1) = Eigen::Vector3f::UnitZ().cross(inward);
    pose.linear().col(2) = Eigen::Vector3f::UnitZ();
    pose.translation() = At(right, up, in);
    return pose;
  }
};

/// North, south, east, west, as in WallSide.
std::array<Wall, 4> WallsOf(const HallSpec& hall);

/// Where a door is in its wall: `middle` metres to the right of the wall's corner.
struct Opening {
  Wall wall;
  float middle = 0, width = 0, height = 0;
};

Opening OpeningOf(const HallSpec& hall, const DoorSpec& door);

}  // namespace aisle::sim
