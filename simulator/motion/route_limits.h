#pragma once

#include <limits>

namespace aisle::sim {

/// What a mover cannot exceed. An infinite limit is none.
struct RouteLimits {
  double acceleration_mps2 = 0.5;          ///< along the path, speeding up and slowing down
  double lateral_acceleration_mps2 = 0.8;  ///< slows it down in corners
  double turn_rate_rad_s = 0.8;            ///< in corners and on the spot
  double turn_acceleration_rad_s2 = 1.5;   ///< on the spot
  bool turns_on_the_spot = true;           ///< false: a car-like vehicle
  /// How fast the curvature of its way changes while it drives, 1/(m s): steering. Infinite: a line
  /// meets an arc, as feet can.
  double curvature_rate_per_m_s = std::numeric_limits<double>::infinity();
  /// Change of the lateral acceleration as a corner begins and ends.
  double lateral_jerk_mps3 = std::numeric_limits<double>::infinity();
  /// What the actuators follow where a corner begins and ends: the change of the curvature a second
  /// by a wheel that is steered, of the turn rate by two that are driven.
  double steered_curvature_rate_per_m_s = std::numeric_limits<double>::infinity();
  double driven_turn_acceleration_rad_s2 = std::numeric_limits<double>::infinity();
  /// Change of the acceleration along the path. On the spot the turn's acceleration builds up in
  /// the same time. Infinite: both change at once.
  double jerk_mps3 = std::numeric_limits<double>::infinity();

  double turn_jerk_rad_s3() const {
    return turn_acceleration_rad_s2 * (jerk_mps3 / acceleration_mps2);
  }
};

}  // namespace aisle::sim
