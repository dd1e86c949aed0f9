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
  double limp = 0;  ///< share by which the first half of each cycle from there is shorter than the
                    ///< second: the stance of the right leg, from where it takes the weight over to
                    ///< where it gives it back; below 1
  double natural_speed_mps() const { return stride_m / duration_s; }
};

/// How far through its walk cycle a person is.
struct GaitState {
  double cycles = 0;     ///< walk cycles so far; the fraction is the phase, backwards counts down
  double amplitude = 0;  ///< length of the steps as a share of the clip's: 0 stands, 1 as in it
};

/// Couples a walk cycle to the ground: stride shrinks with the square root of speed below the
/// clip's natural speed (down to a creep), so cadence does too (walking people divide speed about
/// evenly between the two: Grieve & Gear, Ergonomics 9, 1966), and vanishes at rest. The phase is
/// the exact integral of speed over stride; steps of a walk are shortened a little so that it ends
/// with a whole step. On the spot nobody steps faster than feet can: they stay while the body turns
/// a little.
class Gait {
 public:
  Gait() = default;
  /// Of a route without a jerk limit: speed changes evenly within each phase.
  Gait(Route route, const GaitStyle& style);

  GaitState At(double time_s) const;
  /// Phase in the middle of the half that a limp shortens.
  double SparedPhase() const { return style_.rest_phase + 0.25; }

 private:
  double Amplitude(double speed_mps) const;
  double SparedHalf() const;
  double Limped(double even) const;
  double Even(double cycles) const;
  double CyclesWithin(const Route::Leg& leg, double elapsed_s) const;
  double CyclesWhile(double from_mps, double acceleration_mps2, double duration_s) const;

  Route route_;
  GaitStyle style_;
  /// How a leg of the route is stepped.
  struct Steps {
    double even_before = 0;  ///< cycles as they would be counted without a limp
    double density = 0;      ///< of those, over those of the free stride, so that whole steps fit
    double shortening = 0;   ///< a step's length over that of the free stride
  };
  std::vector<Steps> steps_;  ///< per leg
};

}  // namespace aisle::sim
