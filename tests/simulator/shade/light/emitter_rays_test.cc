#include "simulator/shade/light/emitter_rays.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

namespace aisle::sim {
namespace {

TEST(RaysForShare, ArePowersOfTwoThatRiseWithTheShareWithinTheirBounds) {
  int before = 0;
  for (float share = 0; share <= 1; share += 0.001f) {
    const int rays = RaysForShare(share, 128, 4, 64);
    EXPECT_TRUE(std::has_single_bit(static_cast<unsigned>(rays))) << share;
    EXPECT_GE(rays, std::max(before, 4));
    EXPECT_LE(rays, 64);
    if (rays > 4 && rays < 64) {
      EXPECT_LE(std::abs(std::log2(static_cast<float>(rays) / (share * 128))), 0.5001f) << share;
    }
    before = rays;
  }
}

TEST(Places8, FewerPointsAreAmongMoreAndEachPlaceHasItsOwn) {
  std::vector<ShadowedPlace> places;
  for (std::uint32_t i = 0; i < 5; ++i) {
    places.push_back({{{static_cast<float>(i), 0, 0}, {0, 0, 1}}, 100 + 7 * i});
  }
  const Places8 lanes(places);
  for (int k = 0; k < 8; ++k) EXPECT_EQ(lanes.valid[k], k < 5 ? -1 : 0);
  for (int i = 0; i < 64; ++i) {
    const auto [a, b] = lanes.PlaceOnEmitter(i);
    for (int k = 0; k < 5; ++k) {
      EXPECT_GE(std::min(a[k], b[k]), -1);
      EXPECT_LT(std::max(a[k], b[k]), 1);
      for (int other = 0; other < k; ++other) {
        EXPECT_GT(std::abs(a[k] - a[other]) + std::abs(b[k] - b[other]), 1e-3f);
      }
    }
    // The same place among others has the same points.
    const Places8 alone{std::span<const ShadowedPlace>(places).subspan(3, 1)};
    EXPECT_EQ(alone.PlaceOnEmitter(i).first[0], a[3]);
    EXPECT_EQ(alone.PlaceOnEmitter(i).second[0], b[3]);
  }
}

TEST(EightOnEmitter, AreTheSamePointsOneALane) {
  const std::array<ShadowedPlace, 1> place = {{{{{1, 2, 3}, {0, 0, 1}}, 4711}}};
  const Places8 one{std::span<const ShadowedPlace>(place)};
  for (int first = 0; first < 128; first += kLanes) {
    const auto [a, b] = EightOnEmitter(one, first);
    for (int k = 0; k < kLanes; ++k) {
      EXPECT_EQ(a[k], one.PlaceOnEmitter(first + k).first[0]);
      EXPECT_EQ(b[k], one.PlaceOnEmitter(first + k).second[0]);
    }
  }
}

/// Cutting loses nothing: the pieces' areas and powers sum to the lamps', and each lies in its own.
TEST(Emitters, ArePiecesOfTheirLampsThatSumToThem) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> side(0.05f, 9), high(1, 8);
  std::vector<AreaLight> lights;
  for (int i = 0; i < 30; ++i) {
    lights.push_back({{static_cast<float>(i), 2, high(random)},
                      {side(random), 0, 0},
                      {0, -side(random), 0},
                      side(random)});
  }
  const Emitters emitters(lights, 0.2f);
  EXPECT_EQ(emitters.stride() % 8, 0u);
  EXPECT_GE(emitters.stride(), emitters.size());
  std::vector<double> power(lights.size()), area(lights.size());
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const Emitters::Emitter& e = emitters[i];
    const AreaLight& light = lights[e.light];
    const Eigen::Vector3f off = e.center - light.center;
    EXPECT_LE(std::abs(off.x()) + e.half_u.norm(), light.half_u.norm() * 1.0001f);
    EXPECT_LE(std::abs(off.y()) + e.half_v.norm(), light.half_v.norm() * 1.0001f);
    EXPECT_NEAR(e.normal.z(), -1, 1e-6f);
    power[e.light] += e.power;
    area[e.light] += 4 * e.half_u.cross(e.half_v).norm();
  }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const double whole = 4 * lights[i].half_u.cross(lights[i].half_v).norm();
    EXPECT_NEAR(area[i], whole, 1e-4 * whole) << i;
    EXPECT_NEAR(power[i], whole * lights[i].radiance, 1e-4 * whole * lights[i].radiance) << i;
  }
}

/// The closed form at a place is the sum over many small pieces of lamp, cos · cos' / r² each.
TEST(Emitters, UnshadowedLightIsTheIntegralOverTheLamp) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> at(-3, 3), up(0, 1.5f), dim(0, 1);
  std::vector<AreaLight> lights;
  for (int i = 0; i < 11; ++i) {
    lights.push_back(
        {{at(random), at(random), 4}, {0.75f, 0, 0}, {0, -0.2f, 0}, 2 + at(random) / 3});
  }
  const Emitters emitters(lights, 0);
  ASSERT_EQ(emitters.size(), lights.size());
  std::vector<float> scale;
  for (std::size_t i = 0; i < lights.size(); ++i) scale.push_back(dim(random));
  for (int round = 0; round < 50; ++round) {
    const SurfacePoint place{{at(random), at(random), up(random)},
                             Eigen::Vector3f(at(random), at(random), 3).normalized()};
    for (std::size_t first = 0; first < emitters.stride(); first += 8) {
      const F8 got = emitters.Unshadowed(place, scale, first);
      for (std::size_t k = 0; k < 8; ++k) {
        double expected = 0;
        constexpr int kSide = 24;
        for (int c = 0; first + k < lights.size() && c < kSide * kSide; ++c) {
          const AreaLight& light = lights[first + k];
          const float u = (2 * static_cast<float>(c % kSide) + 1) / kSide - 1;
          const float v = (2 * static_cast<float>(c / kSide) + 1) / kSide - 1;
          const Eigen::Vector3f way =
              light.center + u * light.half_u + v * light.half_v - place.position;
          const double here = std::max(0.0f, place.normal.dot(way)), there = way.z();
          expected += scale[first + k] * light.radiance * 4 * 0.75 * 0.2 / (kSide * kSide) * here *
                      there / std::pow(way.squaredNorm(), 2);
        }
        EXPECT_NEAR(got[static_cast<int>(k)], expected, 0.01 * expected + 4e-4);
      }
    }
  }
}

}  // namespace
}  // namespace aisle::sim
