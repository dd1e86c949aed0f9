#pragma once

#include <limits>
#include <span>
#include <vector>

#include "harness/contract/floor.h"

namespace aisle {

/// A simple polygon on the floor, metres, its corners in order; three or more.
using Polygon = std::vector<Eigen::Vector2d>;

/// All within a radius of a line; a disc where its ends coincide.
struct Capsule {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
  double radius_m = 0;
};

/// The polygon with its frame at a pose.
Polygon At(const FloorPose& pose, const Polygon& polygon);

bool Contains(const Polygon& polygon, const Eigen::Vector2d& point);

/// Distance of two shapes, 0 where they touch or overlap.
double Distance(const Polygon& a, const Polygon& b);
double Distance(const Polygon& polygon, const Capsule& capsule);
/// Of two lines: from a to b, from c to d.
double Distance(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Eigen::Vector2d& d);

/// The farthest corner from the frame's origin: bounds how far any point moves in a turn.
double ReachOf(const Polygon& polygon);

/// The speed of the fastest corner of a polygon that moves ahead, along x, and turns about its
/// frame's origin; of a convex one no point is faster. 0 or more.
double FastestCorner(const Polygon& polygon, double speed_mps, double turn_rate_rad_s);

/// The smallest rectangle along the axes that holds a polygon.
struct Box {
  Eigen::Vector2d low, high;
};
Box BoxOf(const Polygon& polygon);

}  // namespace aisle
