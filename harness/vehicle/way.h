#pragma once

#include <vector>

#include "harness/contract/floor.h"

namespace aisle {

/// A point of a way that is to be driven.
struct WayPoint {
  double distance_m = 0;  ///< from the leg's start
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0;      ///< of travel: the vehicle's own, or where its back looks in reverse
  double curvature_per_m = 0;  ///< positive: travel turns left
  double speed_mps = 0;        ///< fastest there
};

/// One stretch: a drive, a turn on the spot, a pause.
struct WayLeg {
  enum class Kind { kDrive, kTurn, kPause } kind = Kind::kPause;
  double duration_s = 0;              ///< as planned
  std::vector<WayPoint> points = {};  ///< of a drive: two or more, distances rise from 0
  bool reverse = false;               ///< of a drive: backwards
  double turn_to_rad = 0;             ///< of a turn: the vehicle's heading at its end

  double length_m() const { return points.empty() ? 0 : points.back().distance_m; }
};
using Way = std::vector<WayLeg>;

/// The way at a distance. Before its start and beyond its end it goes straight on.
WayPoint PointAt(const WayLeg& leg, double distance_m);

/// Where on a leg a point is.
struct OnWay {
  double distance_m = 0;     ///< of the nearest point; beyond the end it goes straight on
  double cross_track_m = 0;  ///< left of the direction of travel positive
  double heading_rad = 0;    ///< of travel there
};

/// The nearest point of a drive within so many metres before and after a distance where it was
/// before: a way that comes by the same place twice is followed in its order.
OnWay Nearest(const WayLeg& leg, const Eigen::Vector2d& point, double around_m, double back_m = 0.5,
              double ahead_m = 1.5);

/// The same leg with speeds from which the vehicle can brake for the bends ahead:
/// v(s)^2 <= v(s')^2 + 2 braking (s' - s) for all s' > s. The end itself is no bend.
WayLeg WithBraking(WayLeg leg, double braking_mps2);

}  // namespace aisle
