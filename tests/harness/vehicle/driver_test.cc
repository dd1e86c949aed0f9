#include "harness/vehicle/driver.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

constexpr double kTick_s = 0.01;

WayLeg Straight(double length_m, double speed_mps) {
  WayLeg leg{.kind = WayLeg::Kind::kDrive};
  for (int k = 0; k <= static_cast<int>(length_m / 0.02); ++k) {
    leg.points.push_back(
        {.distance_m = 0.02 * k, .position = {0.02 * k, 0}, .speed_mps = speed_mps});
  }
  return leg;
}

/// An S of two quarter circles whose curvature changes by clothoid-like ramps, between straights.
WayLeg Curved(double radius_m, double speed_mps) {
  WayLeg leg{.kind = WayLeg::Kind::kDrive};
  FloorPose at;
  double curvature = 0;
  const double turn = std::numbers::pi / 2, ramp_m = 0.8;
  const double arc_m = turn * radius_m - ramp_m;
  const std::vector<std::pair<double, double>> pieces = {{3, 0},       {ramp_m, 1}, {arc_m, 0},
                                                         {ramp_m, -1}, {2, 0},      {ramp_m, -1},
                                                         {arc_m, 0},   {ramp_m, 1}, {4, 0}};
  double distance = 0;
  for (const auto& [length, sign] : pieces) {
    const int steps = static_cast<int>(length / 0.02);
    for (int k = 0; k < steps; ++k) {
      leg.points.push_back({distance, at.position, at.heading_rad, curvature, speed_mps});
      const double step = length / steps;
      curvature += sign / radius_m / steps;
      at = AlongArc(at, step, curvature * step);
      distance += step;
    }
  }
  leg.points.push_back({distance, at.position, at.heading_rad, 0, speed_mps});
  for (WayPoint& point : leg.points) {
    point.speed_mps =
        std::min(point.speed_mps, std::sqrt(0.5 / std::max(1e-9, std::abs(point.curvature_per_m))));
  }
  return leg;
}

struct Driven {
  PlantState end;
  double worst_m = 0;
  double time_s = 0;
  DriverState driver;
};

/// Drives with perfect knowledge of where it is.
Driven DriveTrue(const Way& way, const PlantOptions& plant, const DriverOptions& options,
                 PlantState state = {}) {
  Driven driven;
  const Way prepared = Prepare(way, options);
  DriverState driver;
  double on_m = 0;
  for (driven.time_s = 0; driven.time_s < 200 && !driver.arrived; driven.time_s += kTick_s) {
    const DriverStep step = DriveAlong(prepared, driver,
                                       {.belief = state.pose,
                                        .speed_mps = state.AheadSpeed(plant.kind),
                                        .turn_rate_rad_s = state.turn_rate_rad_s,
                                        .duration_s = kTick_s},
                                       options);
    driver = step.state;
    state = Move(state, step.command, kTick_s, plant).state;
    if (driver.leg < way.size() && way[driver.leg].kind == WayLeg::Kind::kDrive) {
      const OnWay at = Nearest(way[driver.leg], state.pose.position, on_m);
      on_m = at.distance_m;
      driven.worst_m = std::max(driven.worst_m, std::abs(at.cross_track_m));
    } else {
      on_m = 0;
    }
  }
  driven.end = state;
  driven.driver = driver;
  return driven;
}

class DriverTest : public testing::TestWithParam<std::tuple<SteeringLaw, VehicleKind>> {
 protected:
  DriverTest() {
    options_.law = std::get<0>(GetParam());
    plant_.kind = std::get<1>(GetParam());
  }
  DriverOptions options_;
  PlantOptions plant_;
};
INSTANTIATE_TEST_SUITE_P(
    Laws, DriverTest,
    testing::Combine(testing::Values(SteeringLaw::kPurePursuit, SteeringLaw::kKanayama),
                     testing::Values(VehicleKind::kDifferential, VehicleKind::kTricycle)));

TEST_P(DriverTest, StopsWithinTwoMillimetresOfTheEndOfAStraight) {
  const Driven driven = DriveTrue({Straight(6, 1)}, plant_, options_);
  EXPECT_TRUE(driven.driver.arrived);
  EXPECT_NEAR(driven.end.pose.position.x(), 6, 2e-3);
  EXPECT_LT(driven.worst_m, 1e-6);
}

TEST_P(DriverTest, FollowsABendyWayWithinCentimetresAndEndsOnIt) {
  const WayLeg leg = Curved(1.5, 1.0);
  const Driven driven = DriveTrue({leg}, plant_, options_);
  EXPECT_TRUE(driven.driver.arrived);
  EXPECT_LT(driven.worst_m, 0.045);
  EXPECT_LT((driven.end.pose.position - leg.points.back().position).norm(), 4e-3);
  EXPECT_NEAR(driven.end.pose.heading_rad, leg.points.back().heading_rad, 0.005);
}

TEST_P(DriverTest, ComesBackFromBesideItsWay) {
  PlantState beside;
  beside.pose = {{0, 0.15}, 0.1};
  const Driven driven = DriveTrue({Straight(8, 0.8)}, plant_, options_, beside);
  EXPECT_LT(std::abs(driven.end.pose.position.y()), 2e-3);
  EXPECT_LT(std::abs(driven.end.pose.heading_rad), 5e-3);
}

TEST_P(DriverTest, BackwardsIsFollowedAsWell) {
  WayLeg leg = Straight(4, 0.5);
  for (WayPoint& point : leg.points) {
    point.position.x() *= -1;
    point.heading_rad = std::numbers::pi;
  }
  leg.reverse = true;
  PlantState beside;
  beside.pose.position.y() = 0.05;
  const Driven driven = DriveTrue({leg}, plant_, options_, beside);
  EXPECT_NEAR(driven.end.pose.position.x(), -4, 3e-3);
  EXPECT_LT(std::abs(driven.end.pose.position.y()), 3e-3);
}

TEST(DriverLegsTest, PausesLastAndTurnsEndWhereTheyShould) {
  const Way way = {Straight(1, 0.8),
                   {.kind = WayLeg::Kind::kPause, .duration_s = 2.5},
                   {.kind = WayLeg::Kind::kTurn, .turn_to_rad = std::numbers::pi / 2}};
  const DriverOptions options;
  const Driven with = DriveTrue(way, {}, options);
  const Driven without = DriveTrue({way[0], way[2]}, {}, options);
  EXPECT_NEAR(with.end.pose.heading_rad, std::numbers::pi / 2, 3e-3);
  EXPECT_NEAR(with.time_s - without.time_s, 2.5, 0.02);
}

TEST(DriverLegsTest, HalfATurnIsTurnedThePlansWayWhateverTheBelief) {
  const Way way = {{.kind = WayLeg::Kind::kTurn, .turn_to_rad = std::numbers::pi}};
  for (const double heading : {-3e-3, 0.0, 3e-3}) {
    PlantState start;
    start.pose.heading_rad = heading;
    const Driven driven = DriveTrue(way, {}, {}, start);
    EXPECT_NEAR(driven.end.pose.heading_rad, std::numbers::pi, 3e-3) << heading;
  }
}

TEST(DriverLegsTest, CreepsWhileItKnowsNoPose) {
  const DriverOptions options;
  const Way way = Prepare({Straight(20, 1.5)}, options);
  const DriverStep step =
      DriveAlong(way, {.leg = 0, .on_leg_m = 5},
                 {.belief = {{5, 0}, 0}, .speed_mps = 1, .degraded = true}, options);
  EXPECT_DOUBLE_EQ(step.command.speed_mps, options.degraded_mps);
}

TEST(DriverLegsTest, CreepsInATurnOnTheSpotToo) {
  DriverOptions options;
  const Way way = {{.kind = WayLeg::Kind::kTurn, .turn_to_rad = std::numbers::pi}};
  for (const double reach_m : {0.5, 1.0, 2.5}) {
    options.reach_m = reach_m;
    for (const double heading : {0.0, 2 * std::numbers::pi, std::numbers::pi - 0.004}) {
      const auto rate = [&](bool degraded) {
        const DriverInput input{
            .belief = {{0, 0}, heading}, .turn_rate_rad_s = 0, .degraded = degraded};
        return DriveAlong(way, {}, input, options).command.turn_rate_rad_s;
      };
      EXPECT_LE(std::abs(rate(true)) * reach_m, options.degraded_mps + 1e-12);
      EXPECT_GT(rate(true) * rate(false), 0) << "the same way round, and it goes on";
      EXPECT_LE(std::abs(rate(true)), std::abs(rate(false)));
    }
  }
}

TEST(WayTest, TheNearestPointIsSoughtWhereTheVehicleIsNotWhereTheWayComesByAgain) {
  WayLeg twice = Straight(4, 1);  // there, and back beside it
  const double end = twice.length_m();
  for (int k = 1; k <= 200; ++k) {
    twice.points.push_back({end + 0.02 * k, {4 - 0.02 * k, 0.01}, std::numbers::pi, 0, 1});
  }
  EXPECT_NEAR(Nearest(twice, {1, 0.01}, 1).distance_m, 1, 0.03);
  EXPECT_NEAR(Nearest(twice, {1, 0}, 7).distance_m, 7, 0.03);
}

TEST(WayTest, CrossTrackIsLeftPositiveAndGoesOnBeyondTheEnds) {
  const WayLeg leg = Straight(2, 1);
  EXPECT_NEAR(Nearest(leg, {1.003, 0.2}, 1).cross_track_m, 0.2, 1e-12);
  EXPECT_NEAR(Nearest(leg, {1.003, 0.2}, 1).distance_m, 1.003, 1e-12);
  EXPECT_NEAR(Nearest(leg, {2.5, -0.1}, 2).distance_m, 2.5, 1e-12);
}

TEST(WayTest, BrakingForABendBeginsInTime) {
  WayLeg leg = Straight(4, 1);
  leg.points.back().speed_mps = 0.2;
  const WayLeg braked = WithBraking(leg, 0.4);
  for (const WayPoint& point : braked.points) {
    const double allowed = std::sqrt(0.04 + 2 * 0.4 * (braked.length_m() - point.distance_m));
    EXPECT_NEAR(point.speed_mps, std::min(1.0, allowed), 1e-9);
  }
}

}  // namespace
}  // namespace aisle
