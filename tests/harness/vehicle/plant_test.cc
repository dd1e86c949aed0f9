#include "harness/vehicle/plant.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

constexpr double kTick_s = 0.01;

/// Drives for a time under one command, step by step.
PlantState DriveFor(PlantState state, const DriveCommand& command, double duration_s,
                    const PlantOptions& options, double step_s = kTick_s) {
  const int steps = static_cast<int>(std::lround(duration_s / step_s));
  for (int k = 0; k < steps; ++k) state = Move(state, command, step_s, options).state;
  return state;
}

PlantOptions Ideal(VehicleKind kind) {
  PlantOptions options;
  options.kind = kind;
  options.lag_s = 0;
  options.acceleration_mps2 = options.braking_mps2 = 1e9;
  options.turn_acceleration_rad_s2 = options.steering_rate_rad_s = 1e9;
  return options;
}

TEST(PlantTest, ConstantCommandsGiveExactCirclesWhateverTheStep) {
  const double v = 0.8, w = 0.5, t = 7.3;
  for (const VehicleKind kind : {VehicleKind::kDifferential, VehicleKind::kTricycle}) {
    for (const double step_s : {0.001, 0.01, 0.1}) {
      const PlantOptions options = Ideal(kind);
      PlantState start;  // its wheel looks where it has to: a tricycle turns it before it pushes
      start.steering_rad = std::atan2(options.wheelbase_m * w, v);
      const PlantState end = DriveFor(start, {v, w}, t, options, step_s);
      EXPECT_NEAR(end.pose.heading_rad, w * t, 1e-6) << step_s;
      EXPECT_NEAR(end.pose.position.x(), v / w * std::sin(w * t), 1e-6) << step_s;
      EXPECT_NEAR(end.pose.position.y(), v / w * (1 - std::cos(w * t)), 1e-6) << step_s;
    }
  }
}

TEST(PlantTest, ATricyclesCurvatureIsTheTangentOfItsSteeringOverTheWheelbase) {
  PlantOptions options = Ideal(VehicleKind::kTricycle);
  options.wheelbase_m = 1.3;
  const PlantState state = DriveFor({}, {0.9, 0.4}, 2 * kTick_s, options);
  EXPECT_NEAR(std::tan(state.steering_rad) / options.wheelbase_m, 0.4 / 0.9, 1e-12);
  EXPECT_NEAR(state.AheadSpeed(options.kind), 0.9, 1e-12);
}

TEST(PlantTest, ATricycleBackwardsTurnsAsItIsTold) {
  const PlantState end = DriveFor({}, {-0.5, 0.3}, 2, Ideal(VehicleKind::kTricycle));
  EXPECT_NEAR(end.pose.heading_rad, 0.6, 1e-3);
  EXPECT_LT(end.pose.position.x(), -0.8);
}

/// As far as a vehicle turns that was told to stop in a turn on the spot, step by step.
TEST(PlantTest, AProtectiveStopTurnsAsFarAsIsForetold) {
  for (const VehicleKind kind : {VehicleKind::kDifferential, VehicleKind::kTricycle}) {
    for (const double wheelbase_m : {0.9, 2.0}) {
      for (const double rate : {0.02, 0.8}) {
        PlantOptions options;
        options.kind = kind;
        options.wheelbase_m = wheelbase_m;
        const PlantState turning = DriveFor({}, {0, rate}, 6, options);
        ASSERT_NEAR(turning.turn_rate_rad_s, rate, 0.05 * rate);
        const PlantState end = DriveFor(turning, {.protective_stop = true}, 4, options);
        const double turned = WrapAngle(end.pose.heading_rad - turning.pose.heading_rad);
        EXPECT_NEAR(StoppingTurn(turning.turn_rate_rad_s, options), turned, 1e-3);
        const Eigen::Vector2d way = end.pose.position - turning.pose.position;
        EXPECT_NEAR(way.norm(), turned * TurningRadius(options), 0.02 * way.norm() + 1e-4);
      }
    }
  }
}

/// The whole of a turn, from a wheel that looks ahead on: what it pushes the vehicle while it turns
/// across is no part of a turn on the spot.
TEST(PlantTest, ATricycleThatTurnsOnTheSpotStaysThere) {
  for (const double steering_deg_s : {20.0, 60.0}) {
    for (const double lag_s : {0.0, 0.1}) {
      for (const double rate : {-0.8, 0.3}) {
        PlantOptions options;
        options.kind = VehicleKind::kTricycle;
        options.max_steering_rad = std::numbers::pi / 2;
        options.steering_rate_rad_s = steering_deg_s * std::numbers::pi / 180;
        options.lag_s = lag_s;
        const PlantState end = DriveFor({}, {0, rate}, 9, options);
        EXPECT_GT(end.pose.heading_rad / rate, 3) << "it turned";
        EXPECT_LT(end.pose.position.norm(), 0.005) << steering_deg_s << ' ' << lag_s;
      }
    }
  }
}

/// And who drives on from there goes where it looks.
TEST(PlantTest, ATricycleSetsOffOnceItsWheelLooksWhereItIsToGo) {
  PlantOptions options;
  options.kind = VehicleKind::kTricycle;
  options.max_steering_rad = std::numbers::pi / 2;
  PlantState across;
  across.steering_rad = options.max_steering_rad;
  const PlantState end = DriveFor(across, {0.8, 0}, 5, options);
  EXPECT_GT(end.pose.position.x(), 1);
  EXPECT_LT(std::abs(end.pose.heading_rad), 0.01);
}

TEST(PlantTest, ALagIsTheExponentialAndItsIntegral) {
  const double tau = 0.15, target = 0.7, t = 0.31;
  const LagStep step = FollowWithLag(0.1, target, tau, 1e9, t);
  EXPECT_NEAR(step.end, target - 0.6 * std::exp(-t / tau), 1e-12);
  EXPECT_NEAR(step.integral, target * t - 0.6 * tau * (1 - std::exp(-t / tau)), 1e-12);
}

TEST(PlantTest, AStepOfAnyLengthIsTheSumOfItsParts) {
  const LagStep whole = FollowWithLag(0.2, 1.5, 0.1, 0.6, 3);
  double value = 0.2, integral = 0;
  for (int k = 0; k < 300; ++k) {
    const LagStep part = FollowWithLag(value, 1.5, 0.1, 0.6, 0.01);
    value = part.end;
    integral += part.integral;
  }
  EXPECT_NEAR(value, whole.end, 1e-9);
  EXPECT_NEAR(integral, whole.integral, 1e-9);
}

TEST(PlantTest, TheRateIsNeverExceeded) {
  double value = 0;
  for (int k = 0; k < 400; ++k) {
    const double next = FollowWithLag(value, 1, 0.1, 0.6, kTick_s).end;
    EXPECT_LE(next - value, 0.6 * kTick_s + 1e-12);
    EXPECT_GE(next, value);
    value = next;
  }
  EXPECT_NEAR(value, 1, 1e-6);
}

TEST(PlantTest, AProtectiveStopTakesTheWayThatItsDecelerationSays) {
  PlantOptions options;
  options.lag_s = 0;
  PlantState state;
  state.speed_mps = 1.2;
  const PlantState end = DriveFor(state, {.protective_stop = true}, 3, options);
  EXPECT_NEAR(end.speed_mps, 0, 1e-12);
  EXPECT_NEAR(end.pose.position.x(), 1.2 * 1.2 / (2 * options.stop_mps2), 1e-9);
}

TEST(PlantTest, AProtectiveStopGoesAsFarAsIsForetold) {
  for (const double lag_s : {0.0, 0.1, 0.5, 2.0}) {
    for (const double speed : {-1.2, 0.05, 1.5}) {
      PlantOptions options;
      options.lag_s = lag_s;
      PlantState state;
      state.speed_mps = speed;
      const PlantState end = DriveFor(state, {.protective_stop = true}, 30, options);
      EXPECT_NEAR(StoppingWay(speed, options), std::abs(end.pose.position.x()), 1e-4) << lag_s;
    }
  }
}

TEST(PlantTest, SpeedTurnRateAndSteeringKeepTheirBounds) {
  PlantOptions options;
  const PlantState fast = DriveFor({}, {99, 99}, 20, options);
  EXPECT_NEAR(fast.speed_mps, options.max_speed_mps, 1e-9);
  EXPECT_NEAR(fast.turn_rate_rad_s, options.max_turn_rate_rad_s, 1e-9);
  options.kind = VehicleKind::kTricycle;
  const PlantState steered = DriveFor({}, {0.1, 9}, 20, options);
  EXPECT_LE(std::abs(steered.steering_rad), options.max_steering_rad + 1e-12);
  EXPECT_LE(std::abs(steered.speed_mps), options.max_speed_mps + 1e-12);
}

TEST(PlantTest, OptionsNameTheRuleThatTheyBreak) {
  EXPECT_EQ(PlantOptions{}.Validate(), "");
  EXPECT_NE(PlantOptions{.stop_mps2 = 0}.Validate().find("stop_mps2"), std::string::npos);
  EXPECT_NE(PlantOptions{.max_steering_rad = 2}.Validate().find("max_steering_rad"),
            std::string::npos);
}

TEST(FloorPoseTest, APoseTimesItsInverseIsNothing) {
  const FloorPose pose{{3, -2}, 2.3};
  const FloorPose nothing = pose * pose.inverse();
  EXPECT_LT(nothing.position.norm(), 1e-12);
  EXPECT_EQ(nothing.heading_rad, 0);
  EXPECT_TRUE((InSpace(pose) * InSpace({{1, 2}, 0.4}))
                  .isApprox(InSpace(pose * FloorPose{{1, 2}, 0.4}), 1e-12));
}

TEST(FloorPoseTest, AnglesAreBroughtWithinHalfATurn) {
  for (const double angle : {-9.0, -3.2, 0.0, 1.0, 3.2, 100.0}) {
    const double wrapped = WrapAngle(angle);
    EXPECT_GT(wrapped, -std::numbers::pi);
    EXPECT_LE(wrapped, std::numbers::pi);
    EXPECT_NEAR(std::remainder(angle - wrapped, 2 * std::numbers::pi), 0, 1e-9);
  }
  EXPECT_DOUBLE_EQ(WrapAngle(-std::numbers::pi), std::numbers::pi);
}

}  // namespace
}  // namespace aisle
