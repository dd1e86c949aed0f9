#pragma once

#include <Eigen/Core>

namespace aisle::sim {

/// A point of a path on the floor plane.
struct PathPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< metres, world x and y
  double heading_rad = 0;      ///< direction of travel, counter-clockwise from world x
  double curvature_per_m = 0;  ///< d heading / d distance; positive turns left
};

/// The point `distance_m` along a clothoid (Euler spiral) from `start`: curvature changes by
/// `sharpness_per_m2` a metre. 0 gives an arc, and a line where the curvature is 0 as well, both in
/// closed form. The position is within 1e-12 of the distance while the heading turns by at most pi.
PathPoint AlongClothoid(const PathPoint& start, double sharpness_per_m2, double distance_m);

}  // namespace aisle::sim
