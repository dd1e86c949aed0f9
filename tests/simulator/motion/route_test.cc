#include "simulator/motion/route.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulator/motion/gait.h"
#include "simulator/motion/vehicle.h"

namespace aisle::sim {
namespace {

using std::numbers::pi;

RoutePlan LoopPlan() {
  RoutePlan plan;
  plan.start_s = 0.5;
  plan.steps.resize(5);
  plan.steps[0].go = {{5, 0}, {5, 4}, {1, 4}};
  plan.steps[0].corner_radius_m = 1.0;
  plan.steps[1].wait_s = 1.5;
  plan.steps[2].go = {{1, 8}};
  plan.steps[2].speed_mps = 0.4;
  plan.steps[3].turn_to_rad = pi;
  plan.steps[4].go = {{3, 8}};
  plan.steps[4].reverse = true;
  return plan;
}

TEST(SpeedProfile, ATrapezoidTakesItsTextbookTime) {
  const SpeedLimit limit{13.6, 0.9};
  const SpeedProfile profile = SpeedProfile::FromRestToRest({&limit, 1}, 0.5);
  EXPECT_NEAR(profile.duration_s(), 13.6 / 0.9 + 0.9 / 0.5, 1e-12);
  EXPECT_NEAR(profile.At(0.9 / 0.5).distance_m, 0.9 * 0.9 / (2 * 0.5), 1e-12);
  const SpeedLimit brief{0.2, 5.0};  // never reaches its cruising speed
  EXPECT_NEAR(SpeedProfile::FromRestToRest({&brief, 1}, 0.5).duration_s(), 2 * std::sqrt(0.4),
              1e-12);
}

TEST(SpeedProfile, SpeedIsContinuousAndWithinEveryLimit) {
  const std::vector<SpeedLimit> limits = {{3, 1.0}, {0.3, 0.4}, {2, 1.2}, {1, 0.2}};
  const SpeedProfile profile = SpeedProfile::FromRestToRest(limits, 0.6);
  double before = 0;
  for (double t = 0; t <= profile.duration_s() + 0.1; t += 1e-3) {
    const Travel now = profile.At(t);
    EXPECT_LE(std::abs(now.speed_mps - before), 0.6e-3 + 1e-9);
    double start = 0;
    for (const SpeedLimit& limit : limits) {
      if (now.distance_m > start + 1e-9 && now.distance_m < start + limit.length_m - 1e-9) {
        EXPECT_LE(now.speed_mps, limit.speed_mps + 1e-9);
      }
      start += limit.length_m;
    }
    before = now.speed_mps;
  }
  EXPECT_NEAR(profile.At(99).distance_m, 6.3, 1e-12);
}

TEST(SpeedProfile, WithAJerkLimitItKeepsEveryLimitAndItsLength) {
  const std::vector<SpeedLimit> limits = {{3, 1.0}, {0.3, 0.4}, {0.02, 0.9}, {2, 1.2}, {1, 0.2}};
  const double h = 1e-4;
  for (const double jerk : {0.5, 2.0, 4.0, 50.0}) {
    const SpeedProfile profile = SpeedProfile::FromRestToRest(limits, 0.6, jerk);
    for (double t = 0; t <= profile.duration_s(); t += 3e-3) {
      const Travel now = profile.At(t), next = profile.At(t + h);
      EXPECT_NEAR((next.distance_m - now.distance_m) / h, now.speed_mps, 0.6 * h) << t;
      EXPECT_NEAR((next.speed_mps - now.speed_mps) / h, now.acceleration_mps2, jerk * h) << t;
      EXPECT_LE(std::abs(now.acceleration_mps2), 0.6 + 1e-9);
      EXPECT_LE(std::abs(next.acceleration_mps2 - now.acceleration_mps2), jerk * h * (1 + 1e-6));
      double start = 0;
      for (const SpeedLimit& limit : limits) {
        const bool within = now.distance_m >= start && now.distance_m <= start + limit.length_m;
        if (within) {
          EXPECT_LE(now.speed_mps, limit.speed_mps + 1e-9) << t << ", jerk " << jerk;
        }
        start += limit.length_m;
      }
    }
    const Travel almost = profile.At(profile.duration_s() - 1e-9);
    EXPECT_NEAR(almost.distance_m, 6.32, 1e-9);
    EXPECT_NEAR(almost.speed_mps, 0, 1e-9);
    EXPECT_NEAR(almost.acceleration_mps2, 0, 1e-6);
  }
}

TEST(Route, AStraightDriveKnowsNothingOfSteering) {
  RoutePlan plan;
  plan.steps.resize(2);
  plan.steps[0].go = {{4, 0}, {9, 0}};
  plan.steps[1].turn_to_rad = 2;
  RouteLimits steering;
  steering.curvature_rate_per_m_s = 0.1;
  steering.lateral_jerk_mps3 = 0.1;
  const Route walked(plan, {}), driven(plan, steering);
  EXPECT_EQ(walked.duration_s(), driven.duration_s());
  for (double t = 0; t < walked.duration_s(); t += 0.013) {
    EXPECT_EQ(walked.At(t).position, driven.At(t).position);
    EXPECT_EQ(walked.At(t).heading_rad, driven.At(t).heading_rad);
    EXPECT_EQ(walked.At(t).speed_mps, driven.At(t).speed_mps);
  }
}

TEST(Route, IsContinuousNeverSidewaysAndItsRatesAreItsDerivatives) {
  const Route route(LoopPlan(), {});
  const double h = 1e-5;
  for (double t = 0.01; t < route.duration_s() + 0.5; t += 0.037) {
    const RouteState before = route.At(t - h), now = route.At(t), after = route.At(t + h);
    const Eigen::Vector2d velocity = (after.position - before.position) / (2 * h);
    const Eigen::Vector2d ahead(std::cos(now.heading_rad), std::sin(now.heading_rad));
    const Eigen::Vector2d left(-ahead.y(), ahead.x());
    EXPECT_NEAR(velocity.dot(left), 0, 1e-4) << t;
    EXPECT_NEAR(velocity.dot(ahead), now.speed_mps, 1e-4) << t;
    EXPECT_NEAR((after.heading_rad - before.heading_rad) / (2 * h), now.yaw_rate_rad_s, 2e-2) << t;
    EXPECT_NEAR((after.odometer_m - before.odometer_m) / (2 * h), now.speed_mps, 1e-4) << t;
    if (before.acceleration_mps2 == after.acceleration_mps2) {  // it jumps without a jerk limit
      EXPECT_NEAR((after.speed_mps - before.speed_mps) / (2 * h), now.acceleration_mps2, 1e-4) << t;
    }
  }
}

TEST(Route, StaysWithinItsLimits) {
  const RouteLimits limits;
  const Route route(LoopPlan(), limits);
  for (double t = 0; t < route.duration_s(); t += 0.01) {
    const RouteState now = route.At(t);
    EXPECT_LE(std::abs(now.acceleration_mps2), limits.acceleration_mps2 + 1e-9);
    EXPECT_LE(std::abs(now.yaw_rate_rad_s), limits.turn_rate_rad_s + 1e-9);
    EXPECT_LE(std::abs(now.yaw_rate_rad_s * now.speed_mps),
              limits.lateral_acceleration_mps2 + 1e-9);
  }
}

TEST(Route, StepsFollowOneAnotherAndEndWhereThePlanSays) {
  const Route route(LoopPlan(), {});
  int step = -1;
  for (double t = 0; t < route.duration_s(); t += 0.01) {
    EXPECT_GE(route.At(t).step, step);
    step = route.At(t).step;
  }
  EXPECT_EQ(step, 4);
  const RouteState end = route.At(1e6);
  EXPECT_TRUE(end.finished);
  EXPECT_TRUE(end.position.isApprox(Eigen::Vector2d(3, 8), 1e-9));
  EXPECT_NEAR(std::cos(end.heading_rad), -1, 1e-9) << "it backed off to the right, looking left";
  EXPECT_EQ(end.speed_mps, 0);
}

TEST(Route, JoinedStepsDoNotStopBetweenThem) {
  RoutePlan plan;
  plan.steps.resize(2);
  plan.steps[0].go = {{4, 0}};
  plan.steps[1].go = {{8, 0}};
  plan.steps[1].speed_mps = 0.5;
  const Route route(plan, {});
  double slowest = 1;
  for (double t = 2.5; t < route.duration_s() - 1.5; t += 0.01) {
    slowest = std::min(slowest, route.At(t).speed_mps);
  }
  EXPECT_NEAR(slowest, 0.5, 1e-9);
}

TEST(Route, JoinedStepsEachBeginWhereTheOneBeforeEnds) {
  RoutePlan plan;
  plan.start_s = 0.7;
  plan.steps.resize(4);
  plan.steps[0].go = {{4, 0}, {4, 3}};
  plan.steps[1].go = {{8, 3}};
  plan.steps[1].speed_mps = 0.5;
  plan.steps[2].go = {{10, 3}, {10, 6}};
  plan.steps[2].corner_radius_m = 0;  // stops and turns within the step
  plan.steps[3].go = {{10, 9}};
  RouteLimits limits;
  limits.turns_on_the_spot = true;
  const Route route(plan, limits);
  constexpr double kTick_s = 5e-4;
  int step = -1, begun = 0;
  double elapsed_s = 0;
  for (double t = 0; t < route.duration_s(); t += kTick_s) {
    const RouteState state = route.At(t);
    if (state.step != step) {
      EXPECT_LT(state.step_elapsed_s, 1e-3) << "step " << state.step;
      ++begun;
    } else if (state.step >= 0) {
      EXPECT_NEAR(state.step_elapsed_s - elapsed_s, kTick_s, 1e-9) << t;
    }
    step = state.step;
    elapsed_s = state.step_elapsed_s;
  }
  EXPECT_EQ(begun, 4);
}

TEST(Route, ACarCannotTurnOnTheSpotAndTheBlamedStepIsNamed) {
  RouteLimits car;
  car.turns_on_the_spot = false;
  RoutePlan plan;
  plan.steps.resize(2);
  plan.steps[0].go = {{4, 0}};
  plan.steps[1].turn_to_rad = pi / 2;
  try {
    Route(plan, car);
    FAIL() << "it was accepted";
  } catch (const RouteError& error) {
    EXPECT_EQ(error.step(), 1);
  }
}

TEST(Route, ACornerThatDoesNotFitSaysWhichRadiusDoes) {
  RouteLimits limits;
  limits.curvature_rate_per_m_s = 3;
  RoutePlan plan;
  plan.steps.resize(1);
  plan.steps[0].go = {{8, 0}, {8, 1}, {4, 1}};
  plan.steps[0].corner_radius_m = 0.6;
  std::string message;
  try {
    Route(plan, limits);
  } catch (const RouteError& error) {
    message = error.what();
  }
  const std::size_t at = message.rfind("; ");
  ASSERT_NE(at, std::string::npos) << message;
  plan.steps[0].corner_radius_m = std::stod(message.substr(at + 2));
  EXPECT_GT(plan.steps[0].corner_radius_m, 0.4);
  EXPECT_NO_THROW(Route(plan, limits)) << message;
}

TEST(Gait, PhaseIsTheIntegralOfSpeedOverStride) {
  const Route route(LoopPlan(), {});
  const GaitStyle style;
  const Gait gait(route, style);
  double cycles = 0;
  const double h = 1e-3;
  for (double t = 0; t < route.duration_s(); t += h) {
    const RouteState middle = route.At(t + h / 2);
    const bool turning = middle.speed_mps == 0;
    const double speed = turning ? 0.25 * std::abs(middle.yaw_rate_rad_s) : middle.speed_mps;
    if (speed != 0) cycles += h * speed / (style.stride_m * gait.At(t + h / 2).amplitude);
    EXPECT_NEAR(gait.At(t + h).cycles, cycles, 2e-3) << t;
  }
}

TEST(Gait, EveryWalkTakesWholeStepsFromRestToRest) {
  const Route route(LoopPlan(), {});
  GaitStyle style;
  style.rest_phase = 0.4;
  const Gait gait(route, style);
  for (const Route::Leg& leg : route.legs()) {
    const double half_cycles = 2 * (gait.At(leg.start_s + leg.duration_s - 1e-9).cycles - 0.4);
    EXPECT_NEAR(half_cycles, std::round(half_cycles), 1e-6) << leg.start_s;
  }
}

TEST(Gait, AtTheNaturalSpeedACycleTakesTheClipsTime) {
  RoutePlan plan;
  const GaitStyle style;
  plan.steps.resize(1);
  plan.steps[0].go = {{50, 0}};
  plan.steps[0].speed_mps = style.natural_speed_mps();
  const Route route(plan, {});
  const Gait gait(route, style);
  // Steps are shortened by up to half a step in the whole walk.
  EXPECT_NEAR(gait.At(20 + style.duration_s).cycles - gait.At(20).cycles, 1, 0.015);
  EXPECT_NEAR(gait.At(20).amplitude, 1, 0.015);
  EXPECT_EQ(gait.At(0).amplitude, 0);
}

TEST(Vehicle, WheelsRollWithoutSlipping) {
  RoutePlan plan;
  plan.steps.resize(1);
  plan.steps[0].go = {{6, 0}, {6, 9}};
  plan.steps[0].corner_radius_m = 3;
  RouteLimits limits;
  limits.turns_on_the_spot = false;
  const Route route(plan, limits);
  const Wheel wheel{0, 0.5, 0.3};
  const double h = 1e-5;
  for (double t = 0.1; t < route.duration_s(); t += 0.11) {
    const RouteState now = route.At(t);
    const double rolled = RolledAngle(wheel, route.At(t + h), 0) - RolledAngle(wheel, now, 0);
    const double hub_speed = now.speed_mps - wheel.y_m * now.yaw_rate_rad_s;
    EXPECT_NEAR(rolled * wheel.radius_m / h, hub_speed, 1e-3);
  }
}

TEST(Vehicle, AxlesOfAllSteeredWheelsMeetInTheCentreOfTheTurn) {
  const double curvature = 0.4;
  for (const Wheel wheel : {Wheel{-1.4, 0.4, 0.2}, Wheel{-1.4, -0.4, 0.2}, Wheel{1.0, 0, 0.2}}) {
    const double steer = SteeringAngle(wheel, curvature);
    const Eigen::Vector2d rolling(std::cos(steer), std::sin(steer));
    const Eigen::Vector2d to_centre(-wheel.x_m, 1 / curvature - wheel.y_m);
    EXPECT_NEAR(rolling.dot(to_centre), 0, 1e-12);
  }
}

TEST(Vehicle, WheelsSteeredByTheCurvatureNeverSlipSideways) {
  RoutePlan plan;
  plan.steps.resize(2);
  plan.steps[0].go = {{6, 0}, {6, 9}, {0, 9}};
  plan.steps[0].corner_radius_m = 3;
  plan.steps[1].go = {{6, 9}};
  plan.steps[1].reverse = true;
  RouteLimits limits;
  limits.turns_on_the_spot = false;
  limits.curvature_rate_per_m_s = 0.5;
  const Route route(plan, limits);
  const double h = 1e-5;
  for (const Wheel wheel : {Wheel{0, 0.5, 0.3}, Wheel{-1.4, 0.4, 0.2}, Wheel{-1.4, -0.4, 0.2}}) {
    const auto touches = [&](const RouteState& state) -> Eigen::Vector2d {
      return state.position +
             Eigen::Rotation2Dd(state.heading_rad) * Eigen::Vector2d(wheel.x_m, wheel.y_m);
    };
    for (double t = 0.05; t < route.duration_s(); t += 0.0317) {
      const RouteState now = route.At(t);
      const double ahead = now.heading_rad + SteeringAngle(wheel, now.curvature_per_m);
      const Eigen::Vector2d axle(-std::sin(ahead), std::cos(ahead));
      const Eigen::Vector2d velocity =
          (touches(route.At(t + h)) - touches(route.At(t - h))) / (2 * h);
      EXPECT_NEAR(velocity.dot(axle), 0, 1e-5) << t << " at " << wheel.x_m;
    }
  }
}

TEST(MastLift, ReachesItsHeightsAndKeepsThem) {
  const std::vector<MastMove> moves = {{1, 1.5}, {10, 0.2}};
  const MastLift mast(moves, 0.4, 0.5);
  EXPECT_EQ(mast.HeightAt(0.5), 0);
  EXPECT_NEAR(mast.HeightAt(9.9), 1.5, 1e-12);
  EXPECT_NEAR(mast.HeightAt(60), 0.2, 1e-12);
  const std::vector<MastMove> hasty = {{1, 1.5}, {2, 0}};
  EXPECT_THROW(MastLift(hasty, 0.4, 0.5), std::invalid_argument);
}

/// A way forwards, with a corner, a pause and another corner.
RoutePlan TowPlan() {
  RoutePlan plan;
  plan.start = {1, 2};
  plan.heading_rad = pi / 2;
  plan.start_s = 0.4;
  plan.steps.resize(3);
  plan.steps[0].go = {{1, 9}, {6, 9}};
  plan.steps[0].corner_radius_m = 1.5;
  plan.steps[1].wait_s = 1;
  plan.steps[2].go = {{11, 9}, {11, 2}};
  plan.steps[2].corner_radius_m = 1.2;
  return plan;
}

TEST(Trailer, IsWhereItsTractorWasThatFarBack) {
  RouteLimits limits;
  const Route tractor(TowPlan(), limits);
  RoutePlan plan = TowPlan();
  plan.behind_m = 2.3;
  const Route trailer(plan, limits);
  for (double t = 0; t < tractor.duration_s() + 2; t += 0.07) {
    const double back = tractor.At(t).odometer_m - plan.behind_m;
    const RouteState state = trailer.At(t);
    EXPECT_DOUBLE_EQ(state.speed_mps, tractor.At(t).speed_mps);
    if (back <= 0) {  // on the line backwards from the start
      EXPECT_NEAR((state.position - Eigen::Vector2d(1, 2 + back)).norm(), 0, 1e-9) << t;
      EXPECT_NEAR(state.heading_rad, pi / 2, 1e-12) << t;
      continue;
    }
    double low = 0, high = t;  // when the tractor was there
    for (int i = 0; i < 80; ++i) {
      const double middle = (low + high) / 2;
      (tractor.At(middle).odometer_m < back ? low : high) = middle;
    }
    EXPECT_NEAR((state.position - tractor.At(high).position).norm(), 0, 1e-6) << t;
    EXPECT_NEAR(state.heading_rad, tractor.At(high).heading_rad, 1e-5) << t;
  }
}

TEST(Trailer, MovesAsItsSpeedAndYawRateSay) {
  RoutePlan plan = TowPlan();
  plan.behind_m = 1.7;
  RouteLimits limits;
  limits.curvature_rate_per_m_s = 0.8;
  const Route trailer(plan, limits);
  constexpr double kStep = 1e-5;
  for (double t = 0.5; t < trailer.duration_s() + 1; t += 0.0637) {
    const RouteState before = trailer.At(t - kStep), now = trailer.At(t),
                     after = trailer.At(t + kStep);
    const Eigen::Vector2d ahead(std::cos(now.heading_rad), std::sin(now.heading_rad));
    EXPECT_NEAR(((after.position - before.position) / (2 * kStep) - now.speed_mps * ahead).norm(),
                0, 1e-3)
        << t;
    EXPECT_NEAR((after.heading_rad - before.heading_rad) / (2 * kStep), now.yaw_rate_rad_s, 1e-3)
        << t;
  }
}

TEST(Trailer, CannotFollowBackwards) {
  RoutePlan plan = TowPlan();
  plan.behind_m = 1;
  plan.steps[2].reverse = true;
  plan.steps[2].go = {{4, 9}};
  EXPECT_THROW(Route(plan, {}), RouteError);
}

}  // namespace
}  // namespace aisle::sim
