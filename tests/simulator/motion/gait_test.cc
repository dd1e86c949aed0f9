#include "simulator/motion/gait.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace aisle::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFastestSteps_per_s = 3.5;

RouteLimits Nimble() {
  return {.acceleration_mps2 = 0.9,
          .turn_rate_rad_s = 110 * kDegree,
          .turn_acceleration_rad_s2 = 250 * kDegree,
          .turns_on_the_spot = true};
}

Route Turning(const std::vector<double>& turns_deg) {
  RoutePlan plan;
  for (const double turn_deg : turns_deg) {
    PacedLeg leg;
    leg.turn_rad = turn_deg * kDegree;
    plan.paced.push_back(leg);
  }
  return {plan, Nimble()};
}

double StepsIn(const Gait& gait, const Route::Leg& leg) {
  constexpr double kBeforeItsEnd_s = 1e-9;
  return 2 * std::abs(gait.At(leg.start_s + leg.duration_s - kBeforeItsEnd_s).cycles -
                      gait.At(leg.start_s).cycles);
}

TEST(Gait, NobodyStepsFasterOnTheSpotThanFeetCan) {
  for (const double turn_deg : {0.01, 0.3, 2.0, 5.0, 9.9, 10.1, 20.0, 33.0, 84.0, 120.0, 180.0}) {
    for (const double way : {-1.0, 1.0}) {
      const Route route = Turning({way * turn_deg});
      const Gait gait(route, {});
      const Route::Leg& leg = route.legs().front();
      EXPECT_LE(StepsIn(gait, leg), kFastestSteps_per_s * leg.duration_s + 1e-6) << turn_deg;
    }
  }
}

/// Feet stay where the body hardly turns, and follow before legs would cross.
TEST(Gait, FeetStayInSmallTurnsAndFollowWhereTheseAddUp) {
  const Route there_and_back = Turning({6, -6, 6, -6, 9, -9});
  const Gait still(there_and_back, {});
  for (const Route::Leg& leg : there_and_back.legs()) EXPECT_NEAR(StepsIn(still, leg), 0, 1e-12);
  EXPECT_EQ(still.At(0.1).amplitude, 0) << "nor are they lifted";

  const Route slight = Turning(std::vector<double>(40, 8));
  const Gait follows(slight, {});
  double twist_deg = 0;
  for (const Route::Leg& leg : slight.legs()) {
    twist_deg += 8;
    const double steps = StepsIn(follows, leg);
    EXPECT_LE(steps, kFastestSteps_per_s * leg.duration_s + 1e-6);
    if (steps > 0.5) twist_deg = 0;
    EXPECT_LE(twist_deg, 16);
  }
}

TEST(Gait, AWalkSetsOffWithStepsThatGrowNoFasterThanTime) {
  RoutePlan plan;
  plan.steps.resize(1);
  plan.steps[0].go = {{5, 0}};
  const Route route(plan, Nimble());
  const Gait gait(route, {});
  for (const double t : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    EXPECT_LE(gait.At(t).amplitude, 4 * t);
  }
}

RoutePlan Straight(double speed_mps, bool reverse) {
  RoutePlan plan;
  plan.steps.resize(1);
  plan.steps[0].go = {{reverse ? -20.0 : 20.0, 0}};
  plan.steps[0].speed_mps = speed_mps;
  plan.steps[0].reverse = reverse;
  return plan;
}

GaitStyle Limping(double limp) { return {1.4, 1.1, 1.8, 0.25, limp}; }

/// When the count of cycles passes a number.
double TimeOf(const Gait& gait, double cycles, double until_s) {
  double before = 0, after = until_s;
  for (int i = 0; i < 60; ++i) {
    const double middle = (before + after) / 2;
    (gait.At(middle).cycles < cycles ? before : after) = middle;
  }
  return after;
}

TEST(Gait, ALimpShortensTheFirstHalfOfEachCycleByItsShare) {
  for (const double speed_mps : {0.5, 1.0}) {
    for (const double limp : {0.0, 0.2, 0.45, 0.7}) {
      const Route route(Straight(speed_mps, false), Nimble());
      const Gait gait(route, Limping(limp));
      for (int cycle = 4; cycle < 8; ++cycle) {
        const double start = TimeOf(gait, 0.25 + cycle, route.duration_s());
        const double middle = TimeOf(gait, 0.25 + cycle + 0.5, route.duration_s());
        const double end = TimeOf(gait, 0.25 + cycle + 1, route.duration_s());
        EXPECT_NEAR((middle - start) / (end - middle), 1 - limp, 1e-6) << limp;
      }
    }
  }
}

/// A limp changes when steps are taken: not how many, nor that a walk ends with a whole one.
TEST(Gait, ALimpKeepsTheCountAndHasAContinuousPace) {
  for (const bool reverse : {false, true}) {
    const Route route(Straight(1, reverse), Nimble());
    const Gait even(route, Limping(0)), lame(route, Limping(0.7));
    EXPECT_NEAR(even.At(100).cycles, lame.At(100).cycles, 1e-9);
    constexpr double kTick_s = 1e-3;
    const auto pace = [&](double t) {
      return (reverse ? -1 : 1) * (lame.At(t + kTick_s).cycles - lame.At(t).cycles) / kTick_s;
    };
    for (double t = kTick_s; t < route.duration_s() - 2 * kTick_s; t += kTick_s) {
      ASSERT_GE(pace(t), 0) << "steps never go back, at " << t;
      ASSERT_NEAR(pace(t), pace(t - kTick_s), 0.06) << t;
    }
  }
}

}  // namespace
}  // namespace aisle::sim
