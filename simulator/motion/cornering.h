#pragma once

#include <vector>

#include "simulator/motion/corner.h"
#include "simulator/motion/route_limits.h"

namespace aisle::sim {

/// A corner of a drive that is to be taken.
struct DriveCorner {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double radius_m = 0;
  double cruise_mps = 0;  ///< speed on the side that ends here, > 0
};

/// How the corners of one drive are taken, one entry per corner.
struct Cornering {
  std::vector<Waypoint> waypoints;
  std::vector<double> speeds_mps;  ///< through the corner; at the ends the cruising speed
  /// Fastest that the actuators follow, where the corner's radius alone would allow as much; else
  /// infinite.
  std::vector<double> followed_mps;
};

/// Every corner as fast as lateral acceleration and turn rate at its radius allow, its clothoids as
/// sharp as lateral jerk, curvature rate and actuators allow at that speed. Where two corners do
/// not fit on the side between them, both are taken more slowly, down to a quarter, so that the
/// steering needs less way; Path::Through refuses what does not fit even then. Throws as SidesOf.
Cornering TakeCorners(const std::vector<DriveCorner>& corners, const RouteLimits& limits);

}  // namespace aisle::sim
