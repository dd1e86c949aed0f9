#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace aisle::sim {

/// A corner of a polyline and how it is rounded; the ends' radii are ignored.
struct Waypoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double corner_radius_m = 0;  ///< the smallest in the corner
  /// Largest change of curvature over distance; infinite: a line meets an arc.
  double sharpness_per_m2 = std::numeric_limits<double>::infinity();
};

/// A rounded corner: a clothoid out of the line, an arc, and the first clothoid's mirror image into
/// the next line.
struct CornerShape {
  double turn_rad = 0;         ///< change of heading, positive to the left
  double curvature_per_m = 0;  ///< >= 0, of the arc
  double sharpness_per_m2 = 0;
  double ramp_m = 0;     ///< length of each clothoid, 0: none
  double arc_m = 0;      ///< length of the arc, 0 where the turn is too short for one
  double tangent_m = 0;  ///< distance from the corner to where each clothoid meets its line
};

/// Rounds a corner that turns by less than pi: 1 / radius is reached where the turn is long enough,
/// else the clothoids meet at a larger radius.
CornerShape ShapeCorner(double turn_rad, double radius_m, double sharpness_per_m2);

/// The sides of a polyline and the turns between them.
struct Sides {
  std::vector<double> lengths_m, headings_rad;
  std::vector<double> turns_rad;  ///< per waypoint, 0 at both ends; in (-pi, pi)
};

/// Throws std::invalid_argument, naming the waypoint's index, when there are fewer than two points,
/// two neighbours coincide or the polyline turns straight back on itself.
Sides SidesOf(const std::vector<Eigen::Vector2d>& points);

/// `angle` brought to (-pi, pi].
double WrapAngle(double angle);

}  // namespace aisle::sim
