#include "simulator/motion/gait.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aisle::sim {
namespace {

/// Turning on the spot is stepping too: as fast as feet this far from the axis move.
constexpr double kTurnArm_m = 0.25;

/// Speed of a leg's profile as the feet see it.
double FootArm(const Route::Leg& leg) { return leg.turn_sign != 0 ? kTurnArm_m : 1.0; }

/// Most that one cycle of two steps turns on the spot.
constexpr double kTurnPerCycle_rad = 75 * std::numbers::pi / 180;

/// Down to here strides shrink with the root of speed; slower, they end at nothing with a slope, as
/// limbs that swing with them do not set off at once.
constexpr double kSlowest_mps = 0.1;

/// A body turns so far over feet that stay.
constexpr double kMostTwist_rad = 10 * std::numbers::pi / 180;

/// Feet are not set down faster than this on the spot.
constexpr double kMostSteps_per_s = 3.5;

/// Whole steps (half cycles) for a walk that would freely take so many cycles: rather one more and
/// shorter, unless the rest is small.
double WholeSteps(double cycles) { return std::max(1.0, std::ceil(2 * cycles - 0.2)) / 2; }

/// Whole steps for a turn that ends with the body so twisted over its feet. Where there is no time
/// for one it stays twisted, within what legs bear.
double WholeSteps(double twist_rad, double duration_s) {
  const double turns = std::abs(twist_rad) / kTurnPerCycle_rad;
  if (std::abs(twist_rad) <= kMostTwist_rad) return 0;
  const double wanted = turns < 0.4 ? 0.5 : std::ceil(turns - 0.1);
  const double most = std::floor(kMostSteps_per_s * duration_s) / 2;
  return std::max(std::min(wanted, most), turns > 1 ? 0.5 : 0.0);
}

}  // namespace

Gait::Gait(Route route, const GaitStyle& style) : route_(std::move(route)), style_(style) {
  double cycles = style_.rest_phase, twist_rad = 0;
  for (const Route::Leg& leg : route_.legs()) {
    const double free = CyclesWithin(leg, leg.duration_s);
    if (leg.turn_sign != 0) twist_rad += leg.turn_sign * leg.profile.length_m();
    const double whole = free == 0            ? 0
                         : leg.turn_sign != 0 ? WholeSteps(twist_rad, leg.duration_s)
                                              : WholeSteps(std::abs(free));
    const double then = cycles + std::copysign(whole, free);
    if (whole == 0) {
      steps_.push_back({.even_before = Even(cycles)});
    } else {
      steps_.push_back({Even(cycles), (Even(then) - Even(cycles)) / free, std::abs(free) / whole});
      twist_rad = 0;
    }
    cycles = then;
  }
}

double Gait::Amplitude(double speed_mps) const {
  const double speed = std::abs(speed_mps), natural = style_.natural_speed_mps();
  if (speed >= kSlowest_mps) {
    return std::min(style_.longest_stride_m / style_.stride_m, std::sqrt(speed / natural));
  }
  const double x = speed / kSlowest_mps;
  return std::sqrt(kSlowest_mps / natural) * x * (3 - x) / 2;
}

/// Integral of speed / stride(speed) while speed changes linearly.
double Gait::CyclesWhile(double from, double acceleration, double duration) const {
  const double natural = style_.natural_speed_mps();
  if (acceleration == 0) {
    return from == 0 ? 0 : from * duration / (style_.stride_m * Amplitude(from));
  }
  const double to = std::max(0.0, from + acceleration * duration);
  // Antiderivative over speed: the stride grows up to a speed, then stays.
  const double longest = style_.longest_stride_m / style_.stride_m;
  const double full = natural * longest * longest;
  const auto integral = [&](double speed) {
    const double creep = std::min(speed, kSlowest_mps);
    const double walk = std::clamp(speed, kSlowest_mps, full), run = std::max(speed, full);
    return std::sqrt(natural) *
               (2 * kSlowest_mps * std::sqrt(kSlowest_mps) *
                    std::log(3 / (3 - creep / kSlowest_mps)) +
                2.0 / 3.0 * (walk * std::sqrt(walk) - kSlowest_mps * std::sqrt(kSlowest_mps))) +
           (run * run - full * full) / (2 * longest);
  };
  return (integral(to) - integral(from)) / (acceleration * style_.stride_m);
}

double Gait::CyclesWithin(const Route::Leg& leg, double elapsed_s) const {
  const double arm = FootArm(leg);
  double cycles = 0;
  for (const SpeedProfile::Phase& phase : leg.profile.phases()) {
    const double span = std::min(phase.duration_s, elapsed_s - phase.start_s);
    if (span <= 0) break;
    cycles += CyclesWhile(arm * phase.start.speed_mps, arm * phase.start.acceleration_mps2, span);
  }
  return leg.reverse ? -cycles : cycles;
}

GaitState Gait::At(double time_s) const {
  const auto& legs = route_.legs();
  if (legs.empty()) return {style_.rest_phase, 0};
  std::size_t index = 0;
  while (index + 1 < legs.size() && legs[index + 1].start_s <= time_s) ++index;
  const Route::Leg& leg = legs[index];
  const double elapsed = std::clamp(time_s - leg.start_s, 0.0, leg.duration_s);
  const double speed = FootArm(leg) * leg.profile.At(elapsed).speed_mps;
  const auto& [before, density, shortening] = steps_[index];
  return {Limped(before + density * CyclesWithin(leg, elapsed)), Amplitude(speed) * shortening};
}

/// How long the first half of a cycle takes, as a share of it.
double Gait::SparedHalf() const { return (1 - style_.limp) / (2 - style_.limp); }

/// The count of cycles whose halves take unequal times, from one whose halves do not. Within each
/// half a cubic with the even pace at both its ends, where both feet stand: the pace is continuous,
/// and rises with the share of the time that is missing (by Fritsch and Carlson's bound, SIAM J.
/// Numer. Anal. 17, 1980, the cubics never turn back).
double Gait::Limped(double even) const {
  if (style_.limp == 0) return even;
  const double since = even - style_.rest_phase, whole = std::floor(since);
  const double spared = SparedHalf(), share = since - whole;
  const bool first = share < spared;
  const double length = first ? spared : 1 - spared;
  const double x = (first ? share : share - spared) / length;
  const double within = length * x * (1 - x) * (1 - 2 * x) + 0.5 * x * x * (3 - 2 * x);
  return style_.rest_phase + whole + (first ? 0 : 0.5) + within;
}

/// The other way round, of a count at rest: some half cycles from the first rest.
double Gait::Even(double cycles) const {
  const double halves = std::round(2 * (cycles - style_.rest_phase));
  const double whole = std::floor(halves / 2);
  return style_.rest_phase + whole + (halves > 2 * whole ? SparedHalf() : 0);
}

}  // namespace aisle::sim
