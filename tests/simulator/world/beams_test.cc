#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulator/scene/load.h"
#include "simulator/world/build.h"
#include "simulator/world/warehouse.h"
#include "tests/simulator/world/mechanism_scene.h"

namespace aisle::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";

Scene SceneOf(const std::string& beams) {
  return ParseScene(kHall + "beams:\n  - " + beams + "\n", "s.yaml");
}

std::int64_t Nano(double time_s) { return std::llround(1e9 * time_s); }

Eigen::Vector3d Direction(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

/// A light that turns is no thing that moves.
TEST(Beams, MoveThoughNothingElseDoes) {
  const Scene scene = ParseScene(kHall + R"(beams:
  - {name: sweep, at_m: [6, 0, 2], rate_hz: 1, brightness: 4}
  - {name: sun, kind: sun, at_m: [6, 0, 5.9], in_roof: true, elevation_deg: 60, moves: [{at_s: 0, over_s: 5, azimuth_deg: 30, elevation_deg: 50, share: 0.5}]}
)",
                                 "s.yaml");
  const World world = BuildWorld(scene, kAssets, 1);
  ASSERT_TRUE(world.has_beams());
  const Snapshot first = world.At(0), later = world.At(Nano(0.3));
  ASSERT_EQ(first.beams.size(), 2u);
  EXPECT_TRUE(first.movers.empty()) << "nothing is there that could move";
  // A turn a second: 108 degrees.
  EXPECT_NEAR(first.beams[0].toward.dot(later.beams[0].toward), std::cos(0.6 * std::numbers::pi),
              1e-5);
  EXPECT_NE(first.beams[1].toward, later.beams[1].toward);
  EXPECT_NEAR(world.At(Nano(9)).beams[1].power, 0.5 * first.beams[1].power, 1e-6);
  EXPECT_EQ(first.light_scale.size(), world.lights().size());
}

TEST(Beams, RestBelowTheirLevel) {
  const Scene calm =
      WithDynamics(SceneOf("{name: sweep, at_m: [6, 0, 2], rate_hz: 1, brightness: 4, level: mid}"),
                   Dynamics::kLow);
  float bounce = 0;
  EXPECT_EQ(BeamsAt(calm, 0, &bounce)[0].toward, BeamsAt(calm, 0.3, &bounce)[0].toward);
}

TEST(Beams, WhatAWindowSpreadsIsWhatItsBarsLeaveOpen) {
  const auto spread = [](const char* bar_m) {
    float bounce = 0;
    BeamsAt(SceneOf(fmt::format("{{name: sun, kind: sun, at_m: [4, 0, 5.9], in_roof: true, "
                                "size_m: [2.4, 1.6], columns: 3, rows: 2, bar_m: {}, "
                                "brightness: 3, elevation_deg: 80}}",
                                bar_m)),
            0, &bounce);
    return bounce;
  };
  const float whole = spread("0");
  EXPECT_GT(whole, 0);
  // Panes of 0.8 x 0.8 m.
  EXPECT_NEAR(spread("0.2") / whole, 0.75 * 0.75, 1e-5);
  EXPECT_EQ(spread("0.8"), 0) << "shut";
}

/// From above it turns as azimuths count: from x towards y.
TEST(Beams, ASpotTurnsTheWayItsRateSays) {
  for (const double rate_hz : {0.25, -0.25}) {
    const Scene scene =
        SceneOf(fmt::format("{{name: sweep, at_m: [6, 0, 2], azimuth_deg: 10, elevation_deg: -20, "
                            "rate_hz: {}}}",
                            rate_hz));
    float bounce = 0;
    for (const double t : {0.0, 0.3, 1.0, 1.7}) {
      const Eigen::Vector3d toward = Direction(10 + 360 * rate_hz * t, -20);
      EXPECT_LT((BeamsAt(scene, t, &bounce)[0].toward.cast<double>() - toward).norm(), 1e-6) << t;
    }
  }
}

TEST(Beams, ASpotsWidthIsAcrossItsWholeCone) {
  for (const double width_deg : {10.0, 30.0, 90.0}) {
    const Scene scene = SceneOf(
        fmt::format("{{name: lamp, at_m: [6, 0, 2], azimuth_deg: 40, width_deg: {}}}", width_deg));
    float bounce = 0;
    const Beam beam = BeamsAt(scene, 0, &bounce)[0];
    const auto cosine = [&](double share) {
      return beam.toward.cast<double>().dot(Direction(40 + share * width_deg, 0));
    };
    EXPECT_GT(cosine(0.49), beam.cos_outer) << width_deg;
    EXPECT_LT(cosine(0.51), beam.cos_outer) << width_deg;
    EXPECT_GT(cosine(0.2), beam.cos_inner) << "full light in the middle";
    EXPECT_GT(beam.cos_inner, beam.cos_outer);
  }
}

/// An integrating sphere's: what a surface sends on is again a flux that meets surfaces, so that
/// irradiance E satisfies area E = reflectance (flux + area E).
TEST(Beams, WhatASpotSpreadsIsUlbrichtsSum) {
  constexpr double kReflectance = 0.35;
  constexpr double kArea_m2 = 2 * 25 * 16 + 2 * 6 * (25 + 16);  // of kHall
  for (const double width_deg : {20.0, 90.0}) {
    const Scene scene = SceneOf(
        fmt::format("{{name: lamp, at_m: [6, 0, 2], width_deg: {}, brightness: 7}}", width_deg));
    float bounce = 0;
    const Beam beam = BeamsAt(scene, 0, &bounce)[0];
    // Ring by ring: Beam says full light within the inner cone and none beyond the outer one.
    double flux = 0;
    constexpr int kRings = 20'000;
    const double step = width_deg / 2 * kDegree / kRings;
    for (int i = 0; i < kRings; ++i) {
      const double angle = (i + 0.5) * step;
      const double t = std::clamp(
          (std::cos(angle) - beam.cos_outer) / (beam.cos_inner - beam.cos_outer), 0.0, 1.0);
      flux += 2 * std::numbers::pi * std::sin(angle) * step * 7 * t * t * (3 - 2 * t);
    }
    EXPECT_NEAR(kArea_m2 * bounce, kReflectance * (flux + kArea_m2 * bounce),
                1e-3 * kReflectance * flux)
        << width_deg;
  }
}

TEST(Beams, OfAFrozenSceneRest) {
  const Scene scene = SceneOf("{name: sweep, at_m: [6, 0, 2], rate_hz: 0.3}");
  const World frozen = BuildWorld(Frozen(scene), kAssets, 1);
  EXPECT_EQ(frozen.At(0).beams[0].toward, frozen.At(Nano(0.7)).beams[0].toward);
  float bounce = 0;
  EXPECT_NE(BeamsAt(scene, 0.7, &bounce)[0].toward, frozen.At(0).beams[0].toward);
}

}  // namespace
}  // namespace aisle::sim
