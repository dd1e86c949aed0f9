#include "simulator/scene/within_reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Scene Driven(const std::string& steps, const std::string& drive) {
  return ParseScene("about: A vehicle drives.\nrig: {start: [0, 0], steps: [" + steps +
                        "]}\nhall: {from: [-9, -9], to: [19, 19]}\nlights: [{height_m: 5}]\n" +
                        drive,
                    "s.yaml");
}

Route WayOf(const Scene& scene) { return {scene.rig.route.plan, scene.rig.route.limits}; }

/// Two corners with room, two that are crowded, a turn on the spot.
const std::string kBends =
    "{go: [[8, 0], [8, 8], [5.8, 8], [5.8, 15]], speed_mps: 0.9, corner_radius_m: 0.5}";
const std::string kTurn = ", {turn_to_deg: 0}";

TEST(WithinReach, ThePlanAsksForNothingThatTwoDrivenWheelsCannotDo) {
  for (const std::string keys :
       {"{turn_rate_deg_s: 20}", "{turn_acceleration_deg_s2: 15}", "{max_speed_mps: 0.3}",
        "{acceleration_mps2: 0.1}", "{braking_mps2: 0.1}", "{}"}) {
    const Scene scene = Driven(kBends + kTurn, "drive: " + keys + "\n");
    const DriveSpec& drive = scene.drive;
    const Route way = WayOf(scene);
    const double h = 1e-4, slack = 1 + 1e-6;
    for (double t = h; t < way.duration_s(); t += 0.0103) {
      const RouteState before = way.At(t - h), now = way.At(t), after = way.At(t + h);
      const double turning_up = (after.yaw_rate_rad_s - before.yaw_rate_rad_s) / (2 * h);
      EXPECT_LE(now.speed_mps, drive.max_speed_mps * slack) << keys << t;
      EXPECT_LE(now.acceleration_mps2, drive.acceleration_mps2 * slack) << keys << t;
      EXPECT_GE(now.acceleration_mps2, -drive.braking_mps2 * slack) << keys << t;
      EXPECT_LE(std::abs(now.yaw_rate_rad_s), drive.turn_rate_rad_s * slack) << keys << t;
      EXPECT_LE(std::abs(turning_up), drive.turn_acceleration_rad_s2 * slack) << keys << t;
    }
  }
}

TEST(WithinReach, ThePlanAsksForNothingThatASteeredWheelCannotDo) {
  for (const std::string keys : {"", ", steering_rate_deg_s: 12", ", wheelbase_m: 2"}) {
    const Scene scene = Driven(kBends, "drive: {kind: tricycle" + keys + "}\n");
    const DriveSpec& drive = scene.drive;
    const Route way = WayOf(scene);
    const double h = 1e-4;
    for (double t = h; t < way.duration_s(); t += 0.0103) {
      const auto steered = [&](double time_s) {
        return std::atan(drive.wheelbase_m * way.At(time_s).curvature_per_m);
      };
      EXPECT_LE(std::abs(steered(t + h) - steered(t - h)) / (2 * h),
                drive.steering_rate_rad_s * (1 + 1e-6))
          << keys << ' ' << t;
    }
  }
}

TEST(WithinReach, ATricycleTurnsOnTheSpotAsFastAsItsWheelRolls) {
  const Scene scene =
      Driven("{go: [[4, 0]], speed_mps: 0.9}, {turn_to_deg: 90}",
             "drive: {kind: tricycle, max_steering_deg: 90, wheelbase_m: 2, max_speed_mps: 1}\n");
  const Route way = WayOf(scene);
  for (double t = 0; t < way.duration_s(); t += 0.01) {
    EXPECT_LE(2 * std::abs(way.At(t).yaw_rate_rad_s), 1 + 1e-9) << t;
  }
}

/// A vehicle that can do all that the rig may be asked goes the very way that the rig goes.
TEST(WithinReach, WhatDoesNotBindChangesNoBit) {
  const Route rig = WayOf(Driven(kBends, ""));
  for (const std::string drive :
       {"{kind: differential}", "{kind: tricycle, steering_rate_deg_s: 700}"}) {
    const Route driven = WayOf(Driven(kBends, "drive: " + drive + "\n"));
    ASSERT_EQ(driven.duration_s(), rig.duration_s()) << drive;
    for (double t = 0; t < rig.duration_s(); t += 0.0103) {
      const RouteState one = rig.At(t), other = driven.At(t);
      EXPECT_EQ(one.position, other.position) << t;
      EXPECT_EQ(one.heading_rad, other.heading_rad) << t;
      EXPECT_EQ(one.speed_mps, other.speed_mps) << t;
    }
  }
}

}  // namespace
}  // namespace aisle::sim
