#include "simulator/shade/light/form_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "simulator/shade/light/direct_light.h"

namespace aisle::sim {
namespace {

/// The light's irradiance at a place by the midpoint rule over steps × steps pieces of it.
double BySumming(const AreaLight& light, const SurfacePoint& place, int steps) {
  const Eigen::Vector3d u = light.half_u.cast<double>(), v = light.half_v.cast<double>();
  const Eigen::Vector3d area = 4 * u.cross(v) / (steps * steps);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Eigen::Vector3d way = (light.center - place.position).cast<double>() +
                                  ((2 * i + 1.0) / steps - 1) * u + ((2 * j + 1.0) / steps - 1) * v;
      sum += std::max(0.0, place.normal.cast<double>().dot(way)) * std::max(0.0, -area.dot(way)) /
             std::pow(way.squaredNorm(), 2);
    }
  }
  return sum * light.radiance;
}

TEST(FormFactor, IsTheIntegralOverThePartAboveTheHorizon) {
  const AreaLight sky{{-10, 3, 39}, {28, 0, 0}, {0, -29, 0}, 0.28f};
  const AreaLight tilted{{1, 2, 3}, {0.4f, 0.3f, 0}, {0.1f, -0.2f, 0.5f}, 2};
  std::vector<Eigen::Vector3f> normals = {{0, 0, 1},        {1, 0, 0},  {-1, 0, 0},     {0, 1, 0},
                                          {0.8f, 0, -0.6f}, {0, 0, -1}, {0.6f, 0, 0.8f}};
  for (const AreaLight& light : {sky, tilted}) {
    for (const Eigen::Vector3f& normal : normals) {
      for (const Eigen::Vector3f& at : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(12, -20, 7)}) {
        const SurfacePoint place{at, normal};
        const double expected = BySumming(light, place, 1500);
        EXPECT_NEAR(UnshadowedIrradiance(light, place), expected, 1e-6 + 1e-4 * expected)
            << normal.transpose() << " at " << at.transpose();
      }
    }
  }
}

TEST(FormFactor, FillsTheSkyAtMost) {
  const AreaLight close{{0, 0, 1e-3f}, {50, 0, 0}, {0, -50, 0}, 1};
  EXPECT_NEAR(UnshadowedIrradiance(close, {{0, 0, 0}, {0, 0, 1}}), std::numbers::pi, 1e-3);
  EXPECT_EQ(UnshadowedIrradiance(close, {{0, 0, 1}, {0, 0, -1}}), 0) << "behind it";
}

/// A facade under one wide patch of sky whose centre lies behind it sees the part before it.
TEST(DirectLight, AFacadeSeesTheSkyWhoseCentreLiesBehindIt) {
  const std::array lights = {AreaLight{{-10, 0, 39}, {28, 0, 0}, {0, -29, 0}, 0.28f}};
  const std::array on = {1.0f};
  const std::array facade = {SurfacePoint{{0, 0, 5}, {1, 0, 0}}};
  const double expected = BySumming(lights[0], facade[0], 1500);
  ASSERT_GT(expected, 0.02);
  EXPECT_NEAR(UnshadowedLight(lights, on, facade)[0], expected, 1e-4);
}

}  // namespace
}  // namespace aisle::sim
