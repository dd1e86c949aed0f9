#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulator/motion/path.h"
#include "simulator/motion/route_limits.h"
#include "simulator/motion/speed_profile.h"

namespace aisle::sim {

/// One step of a route: go along points, wait, or turn on the spot. Exactly one of them.
struct RouteStep {
  std::vector<Eigen::Vector2d> go;  ///< through these points, from where the mover is
  double speed_mps = 1.0;           ///< with `go`: cruising speed
  double corner_radius_m = 0.5;     ///< with `go`: smallest in its corners, 0 stops and turns there
  bool reverse = false;             ///< with `go`: drives backwards
  std::optional<double> wait_s;
  std::optional<double> turn_to_rad;  ///< world heading to turn to, on the spot, the shorter way
  std::string play;                   ///< clip played meanwhile; empty: the mover's usual
};

/// A stretch of a paced way: an arc, along which speed changes evenly.
struct PacedPiece {
  double duration_s = 0;            ///< > 0
  double from_mps = 0, to_mps = 0;  ///< not both 0
  double curvature_per_m = 0;       ///< positive turns left
};

/// A leg of a way whose times are known beforehand, from rest to rest: one of a drive, a turn on
/// the spot and a pause.
struct PacedLeg {
  std::vector<PacedPiece> pieces;
  double turn_rad = 0;
  double pause_s = 0;
};

/// A mover's way through the scene, as a plain description.
struct RoutePlan {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< metres, world
  double heading_rad = 0;                           ///< at the start
  double start_s = 0;                               ///< stands until then
  std::vector<RouteStep> steps;
  std::vector<PacedLeg> paced;  ///< instead of steps
  /// How far behind along its way the mover is: that of a trailer, by the track from the origin of
  /// who tows it to its own. Before the way's start it stands on a line backwards from there.
  double behind_m = 0;
};

/// A plan that cannot be driven, and the step that is to blame.
class RouteError : public std::invalid_argument {
 public:
  RouteError(int step, const std::string& what) : std::invalid_argument(what), step_(step) {}
  int step() const { return step_; }

 private:
  int step_;
};

/// Where a mover is and how it moves, on the floor plane.
struct RouteState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< metres, world
  double heading_rad = 0;  ///< where it looks, continuous over time (not wrapped)
  double speed_mps = 0;    ///< along the heading; negative: backwards
  double acceleration_mps2 = 0;
  double yaw_rate_rad_s = 0;
  double curvature_per_m = 0;  ///< of the track, seen along the heading; 0 when turning on the spot
  double odometer_m = 0;       ///< distance so far, driving backwards counts negative
  int step = -1;               ///< index of the plan's step; -1 before the first
  double step_elapsed_s = 0;   ///< since that step began
  bool finished = false;       ///< the last step is over
};

/// A plan made into motion: a pure function of time. Position, heading and speed are continuous;
/// the velocity is along the heading, always (no sideways motion). With a finite curvature rate the
/// curvature is continuous, so that no point fixed to the mover changes its velocity at once; with
/// a finite jerk the acceleration of the point that the route moves is continuous as well.
class Route {
 public:
  /// One stretch of a route: a drive along a path, a turn on the spot, or a pause.
  struct Leg {
    double start_s = 0;
    double duration_s = 0;
    RouteState start;      ///< state as the leg begins (speed 0: every leg is from rest to rest)
    Path path;             ///< of a drive
    SpeedProfile profile;  ///< metres of a drive, radians of a turn, empty in a pause
    double turn_sign = 0;  ///< ±1 in a turn
    bool reverse = false;
    double step_start_s = 0;  ///< when its step began; in a drive, the first of its steps
    /// Of a drive: the step of each path segment, and when that step began.
    struct SegmentStep {
      int step = -1;
      double start_s = 0;
      /// Fastest that actuators follow its bend, as Cornering has it.
      double followed_mps = std::numeric_limits<double>::infinity();
    };
    std::vector<SegmentStep> segment_steps;
  };

  Route() = default;
  /// Throws RouteError naming the step that cannot be driven, or that a trailer cannot follow
  /// (backwards, on the spot).
  Route(const RoutePlan& plan, const RouteLimits& limits);

  double duration_s() const { return duration_s_; }  ///< until it stands for good
  const std::vector<Leg>& legs() const { return legs_; }
  RouteState At(double time_s) const;

 private:
  RouteState LeadAt(double time_s) const;

  std::vector<Leg> legs_;
  RouteState start_, end_;
  double duration_s_ = 0, behind_m_ = 0;
};

}  // namespace aisle::sim
