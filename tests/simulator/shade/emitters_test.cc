#include "simulator/shade/light/emitters.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "simulator/shade/light/form_factor.h"

namespace aisle::sim {
namespace {

constexpr double kPi = std::numbers::pi;

/// Irradiance under the middle of a rectangle 2a × 2b at height h that faces down (Howell, C-13:
/// four times the form factor of a quarter seen from its corner).
double BelowRectangle(double a, double b, double h, double radiance) {
  const double x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return 4 * radiance * (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / 2;
}

float Total(const Emitters& emitters, const SurfacePoint& place, std::span<const float> scale) {
  float sum = 0;
  for (std::size_t i = 0; i < emitters.stride(); i += kLanes) {
    sum += Sum(emitters.Unshadowed(place, scale, i));
  }
  return sum;
}

TEST(Emitters, ALampSendsWhatItsFormFactorSays) {
  const std::array lights = {AreaLight{{0, 0, 4}, {0.75f, 0, 0}, {0, -0.15f, 0}, 3}};
  const Emitters emitters(lights, 0);
  EXPECT_EQ(emitters.size(), 1u);
  const std::vector<float> on = {1};
  const double expected = BelowRectangle(0.75, 0.15, 4, 3);
  EXPECT_NEAR(Total(emitters, {{0, 0, 0}, {0, 0, 1}}, on), expected, 5e-3 * expected);
}

TEST(Emitters, ASkyIsCutAndSendsWhatItsFormFactorSays) {
  const std::array lights = {AreaLight{{0, 0, 39}, {28, 0, 0}, {0, -29, 0}, 0.28f}};
  const Emitters emitters(lights, 0);
  EXPECT_GE(emitters.size(), 4u);
  const std::vector<float> on = {1}, dim = {0.25f};
  const double expected = BelowRectangle(28, 29, 39, 0.28);
  const SurfacePoint floor{{0, 0, 0}, {0, 0, 1}};
  EXPECT_NEAR(Total(emitters, floor, on), expected, 0.02 * expected);
  EXPECT_NEAR(Total(emitters, floor, dim), 0.25 * expected, 0.02 * expected);
  EXPECT_EQ(Total(emitters, {{0, 0, 0}, {0, 0, -1}}, on), 0);   // it faces away
  EXPECT_EQ(Total(emitters, {{0, 0, 50}, {0, 0, -1}}, on), 0);  // behind the sky
}

TEST(Emitters, SendWhatTheirFormFactorSaysFromAsNearAsCanBe) {
  const AreaLight lamp{{0, 0, 4.6f}, {0, 0.15f, 0}, {0.75f, 0, 0}, 1};
  const Emitters emitters(std::array{lamp}, 0);
  const std::vector<float> scale = {0.5f};
  const float facing = UnshadowedIrradiance(lamp, {{0, 0, 3}, {0, 0, 1}});
  for (const float z : {2.0f, 2.6f, 2.9f, 3.5f, 4.0f, 4.3f, 4.55f}) {
    for (const Eigen::Vector3f& normal :
         {Eigen::Vector3f(0, -1, 0), Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 0, 1)}) {
      for (float x = -1; x <= 1; x += 0.1f) {
        const SurfacePoint place{{x, 0.2f, z}, normal};
        const Eigen::AlignedBox3f box(place.position, place.position);
        const std::vector<std::uint32_t> near = emitters.NearTo(box);
        const float exact = 0.5f * UnshadowedIrradiance(lamp, place);
        EXPECT_NEAR(Sum(emitters.Unshadowed(place, scale, 0, near)), exact,
                    0.03f * std::max(exact, 0.5f * facing))
            << place.position.transpose() << ", facing " << normal.transpose();
      }
    }
  }
  EXPECT_TRUE(emitters.NearTo({Eigen::Vector3f(-5, -5, 0), Eigen::Vector3f(5, 5, 2)}).empty());
}

TEST(Emitters, SharesSumToOneAndFollowTheLampsThatAreOn) {
  std::vector<AreaLight> lights;
  for (int i = 0; i < 11; ++i) {
    lights.push_back({{static_cast<float>(3 * i), 0, 5}, {0.75f, 0, 0}, {0, -0.15f, 0}, 1});
  }
  const Emitters emitters(lights, 0);
  EXPECT_EQ(emitters.stride(), 16u);
  std::vector<float> scale(lights.size(), 1.0f);
  const auto sum = [](const std::vector<float>& shares) {
    return std::accumulate(shares.begin(), shares.end(), 0.0f);
  };
  EXPECT_NEAR(sum(emitters.Shares({7, 1, 1}, scale)), 1, 1e-5);
  scale[2] = 0;
  const std::vector<float> shares = emitters.Shares({7, 1, 1}, scale);
  EXPECT_EQ(shares[2], 0);
  EXPECT_NEAR(sum(shares), 1, 1e-5);
  EXPECT_EQ(sum(emitters.Shares({7, 1, 6}, scale)), 0);  // above all lamps
}

}  // namespace
}  // namespace aisle::sim
