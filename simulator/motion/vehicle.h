#pragma once

#include <span>
#include <vector>

#include "simulator/motion/route.h"

namespace aisle::sim {

/// Where a wheel touches the floor, in the vehicle's frame (x ahead, y left, origin on the axis
/// that does not steer).
struct Wheel {
  double x_m = 0, y_m = 0;
  double radius_m = 0.25;
};

/// Angle a wheel has rolled, about its axle (vehicle's left), positive when driving ahead. Exact
/// for wheels that do not steer: the inner one turns less.
double RolledAngle(const Wheel& wheel, const RouteState& now, double heading_at_start_rad);

/// Angle by which a wheel at `wheel` must be steered so that it rolls without slipping on a track
/// of that curvature (Ackermann), positive to the left.
double SteeringAngle(const Wheel& wheel, double curvature_per_m);

/// Curvature averaged over `window_s`: for show, where a vehicle follows a way without clothoids
/// (it is pushed by somebody who walks), so that its wheels do not jump between lines and arcs.
double SmoothCurvature(const Route& route, double time_s, double window_s);

/// A command to the mast: begin to move to a height at a time.
struct MastMove {
  double at_s = 0;
  double height_m = 0;
};

/// What a forklift's mast does.
inline constexpr double kMastSpeed_mps = 0.35;
inline constexpr double kMastAcceleration_mps2 = 0.4;

/// Height of the forks over time: each move runs from rest to rest.
class MastLift {
 public:
  MastLift() = default;
  /// Throws std::invalid_argument when a move begins before the last one ends, naming its index.
  MastLift(std::span<const MastMove> moves, double speed_mps, double acceleration_mps2);

  double HeightAt(double time_s) const;

 private:
  struct Run {
    double start_s = 0, from_m = 0, sign = 1;
    SpeedProfile profile;
  };
  std::vector<Run> runs_;
};

}  // namespace aisle::sim
