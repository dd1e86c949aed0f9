#include "simulator/shade/light/static_visibility.h"

#include <gtest/gtest.h>

#include <random>

#include "simulator/shade/lanes/hemisphere.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// A floor, a wall across it from x = 0 on to the right at y = 2, three metres high, and one lamp.
World WallBeforeALamp() {
  WorldParts parts;
  parts.instances.push_back({"floor", ObjectClass::kFloor, false});
  parts.materials.resize(1);
  test::MeshBuilder builder;
  builder.Quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0, 1);
  builder.Box({0, 1.9f, 0}, {9, 2.1f, 3}, 0, 1);
  parts.statics = {builder.mesh, builder.instances};
  parts.lights.push_back({{0, 5, 4}, {0.75f, 0, 0}, {0, -0.15f, 0}, 3});
  return World(std::move(parts));
}

/// Of an area light or of an emitter.
template <typename Rectangle>
float BruteForce(const Instant& instant, const Rectangle& light, const Eigen::Vector3f& from) {
  constexpr int kSide = 40;
  int seen = 0;
  Rays8 rays;
  for (int i = 0; i < kSide * kSide; i += kLanes) {
    for (int k = 0; k < kLanes; ++k) {
      const float u = (2 * static_cast<float>((i + k) % kSide) + 1) / kSide - 1;
      const float v = (2 * static_cast<float>((i + k) / kSide) + 1) / kSide - 1;
      SetRay(from, light.center + u * light.half_u + v * light.half_v - from, 0.998f, k, &rays);
    }
    seen += kLanes - std::popcount(instant.Occluded(rays, Coherence::kCoherent, kStaticOnly));
  }
  return static_cast<float>(seen) / (kSide * kSide);
}

TEST(StaticVisibility, IsThePartOfALampThatCanBeSeen) {
  const World world = WallBeforeALamp();
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose({});
  const Emitters emitters(world.lights(), 0);
  const StaticVisibility visibility(emitters, world.statics().mesh, {});
  std::mt19937 random(3);
  std::uniform_real_distribution<float> across(-2, 2), along(-2, 1.5f), up(0.1f, 2);
  double error = 0, partly = 0;
  constexpr int kPlaces = 300;
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::Vector3f at(across(random), along(random), up(random));
    const std::array<ShadowedPlace, 1> place = {{{{at, Eigen::Vector3f::UnitZ()}, 0}}};
    EmitterVisibility seen(1, emitters.stride());
    visibility.Shade(instant, place, &seen);
    const float expected = BruteForce(instant, world.lights()[0], at);
    error += std::abs(seen.Row(0)[0] - expected);
    partly += expected > 0.05f && expected < 0.95f;
  }
  EXPECT_GT(partly, 0.1 * kPlaces);  // the penumbra, which is hard, is among the places
  EXPECT_LT(error / kPlaces, 0.03);
}

/// Sixty lamps in rows, each above a beam that runs along it: what one point of a lamp meets, all
/// its points meet, and likewise for every lamp.
World LampsAboveBeams() {
  WorldParts parts;
  parts.instances.push_back({"floor", ObjectClass::kFloor, false});
  parts.materials.resize(1);
  test::MeshBuilder builder;
  builder.Quad({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, 0, 1);
  for (int x = -5; x < 5; ++x) {
    for (int y = -3; y < 3; ++y) {
      const auto cx = 2 * static_cast<float>(x) + 1, cy = 3 * static_cast<float>(y) + 1.5f;
      parts.lights.push_back({{cx, cy, 6}, {0.6f, 0, 0}, {0, -0.15f, 0}, 3});
    }
  }
  for (int i = -8; i < 8; ++i) {
    const float x = 1.6f * static_cast<float>(i);  // seen from 1 m as far apart as the lamps
    builder.Box({x, -12, 5}, {x + 0.3f, 12, 5.1f}, 0, 1);
  }
  parts.statics = {builder.mesh, builder.instances};
  return World(std::move(parts));
}

TEST(StaticVisibility, ErrsIndependentlyFromPlaceToPlace) {
  const World world = LampsAboveBeams();
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose({});
  const Emitters emitters(world.lights(), 0);
  const StaticVisibility visibility(emitters, world.statics().mesh, {});
  std::mt19937 random(5);
  std::uniform_real_distribution<float> offset(0, 1);
  for (const Eigen::Vector3f& corner :
       {Eigen::Vector3f(-2, -1, 0.5f), Eigen::Vector3f(0.3f, 0.7f, 0.5f),
        Eigen::Vector3f(-1.3f, 0.2f, 0.5f), Eigen::Vector3f(-0.4f, 0.2f, 0.5f)}) {
    // Over the size of a body, errors of single nodes cancel; a bias does not.
    double found = 0, expected = 0;
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector3f at =
          corner + Eigen::Vector3f(offset(random), offset(random), offset(random));
      const std::array<ShadowedPlace, 1> place = {{{{at, Eigen::Vector3f::UnitZ()}, 0}}};
      EmitterVisibility seen(1, emitters.stride());
      visibility.Shade(instant, place, &seen);
      for (std::size_t e = 0; e < emitters.size(); ++e) {
        const float light = emitters.Shares(at, std::vector<float>(world.lights().size(), 1.0f))[e];
        found += light * seen.Row(0)[e];
        expected += light * BruteForce(instant, emitters[e], at);
      }
    }
    EXPECT_NEAR(found / expected, 1, 0.01) << corner.transpose();
  }
}

TEST(StaticVisibility, DoesNotDependOnWhatWasAskedBefore) {
  const World world = WallBeforeALamp();
  const Tracer tracer(world, {});
  const Instant instant = tracer.Pose({});
  const Emitters emitters(world.lights(), 0);
  const StaticVisibility fresh(emitters, world.statics().mesh, {});
  // Forgets after every few nodes.
  const StaticVisibility forgetful(emitters, world.statics().mesh, {.most_nodes = 16});
  std::vector<ShadowedPlace> places;
  for (int i = 0; i < 50; ++i) {
    const auto t = static_cast<float>(i) / 50;
    places.push_back({{{-1 + 2 * t, -0.5f + t, 0.3f + t}, Eigen::Vector3f::UnitZ()}, 0});
  }
  EmitterVisibility all(places.size(), emitters.stride());
  fresh.Shade(instant, places, &all);
  for (std::size_t i = places.size(); i-- > 0;) {
    EmitterVisibility one(1, emitters.stride());
    forgetful.Shade(instant, std::span(places).subspan(i, 1), &one);
    EXPECT_EQ(one.Row(0)[0], all.Row(i)[0]);
  }
}

}  // namespace
}  // namespace aisle::sim
