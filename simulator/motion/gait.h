#pragma once

#include <vector>

#include "simulator/motion/route.h"

namespace aisle::sim {

/// A walk cycle as its clip shows it: one cycle (two steps) covers `stride_m` in `duration_s`.
struct GaitStyle {
  double stride_m = 1.4;
  double duration_s = 1.1;
  double longest_stride_m = 1.4;  ///< faster than it carries, only the cadence rises
  double rest_phase = 0;          ///< of standing: every walk begins and ends half cycles from it
  double limp = 0;  ///< share by which the first half of each cycle from there is shorter, below 1
  double natural_speed_mps() const { return stride_m / duration_s; }
};

/// How far through its walk cycle a person is.
struct GaitState {
  double cycles = 0;     ///< walk cycles so far; the fraction is the phase, backwards counts down
  double amplitude = 0;  ///< length of the steps as a share of the clip's: 0 stands, 1 as in it
};

/// Couples a walk cycle to the ground: stride shrinks with the square root of speed below the
/// clip's natural speed, so cadence does too (walking people divide speed about evenly between the
/// two: Grieve & Gear, Ergonomics 9, 1966), and vanishes at rest. The phase is the exact integral
/// of speed over stride; steps of a walk are shortened a little so that it ends with a whole step.
class Gait {
 public:
  Gait() = default;
  /// Of a route without a jerk limit: speed changes evenly within each phase.
  Gait(Route route, const GaitStyle& style);

  GaitState At(double time_s) const;

 private:
  double Amplitude(double speed_mps) const;
  double Limped(double cycles) const;
  double CyclesWithin(const Route::Leg& leg, double elapsed_s) const;
  double CyclesWhile(double from_mps, double acceleration_mps2, double duration_s) const;

  Route route_;
  GaitStyle style_;
  /// How a leg of the route is stepped.
  struct Steps {
    double cycles_before = 0;
    double density = 1;  ///< cycles over those of the free stride, so that whole steps fit
  };
  std::vector<Steps> steps_;  ///< per leg
};

}  // namespace aisle::sim
