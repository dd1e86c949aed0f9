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

/// Whole steps (half cycles) for a leg that would freely take so many cycles: rather one more and
/// shorter, unless the rest is small.
double WholeSteps(const Route::Leg& leg, double cycles) {
  if (leg.turn_sign != 0) {
    const double turns = leg.profile.length_m() / kTurnPerCycle_rad;
    return turns < 0.4 ? 0.5 : std::ceil(turns - 0.1);
  }
  return std::max(1.0, std::ceil(2 * cycles - 0.2)) / 2;
}

}  // namespace

Gait::Gait(Route route, const GaitStyle& style) : route_(std::move(route)), style_(style) {
  double cycles = style_.rest_phase;
  for (const Route::Leg& leg : route_.legs()) {
    const double free = CyclesWithin(leg, leg.duration_s);
    const double whole = free == 0 ? 0 : WholeSteps(leg, std::abs(free));
    steps_.push_back({cycles, free == 0 ? 1 : whole / std::abs(free)});
    cycles += std::copysign(whole, free);
  }
}

double Gait::Amplitude(double speed_mps) const {
  return std::min(style_.longest_stride_m / style_.stride_m,
                  std::sqrt(std::abs(speed_mps) / style_.natural_speed_mps()));
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
    const double slow = std::min(speed, full), fast = std::max(speed, full);
    return (2.0 / 3.0) * std::sqrt(natural) * slow * std::sqrt(slow) +
           (fast * fast - full * full) / (2 * longest);
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
  const auto& [before, density] = steps_[index];
  return {Limped(before + density * CyclesWithin(leg, elapsed)), Amplitude(speed) / density};
}

/// The same count of half cycles, but the first half of each goes by faster than the second.
double Gait::Limped(double cycles) const {
  if (style_.limp == 0) return cycles;
  const double turn = 2 * std::numbers::pi;
  return cycles + style_.limp / turn * std::sin(turn * (cycles - style_.rest_phase));
}

}  // namespace aisle::sim
