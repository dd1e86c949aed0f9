#include "simulator/shade/light/light_volume.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "simulator/shade/lanes/hemisphere.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

Vector3f Unit(std::mt19937* random) {
  std::normal_distribution<float> normal;
  return Vector3f(normal(*random), normal(*random), normal(*random)).normalized();
}

/// ∫ L(ω) max(0, n·ω) dω by summing over directions all around.
TEST(LightNode, IrradianceIsTheCosineIntegralOfItsRadiance) {
  std::mt19937 random(1);
  const std::vector<Vector3f> directions = SphereDirections(20'000);
  for (int i = 0; i < 40; ++i) {
    // Radiance is nowhere negative where the slope is at most the mean.
    const LightVolume::Node node{
        2, 2 * std::uniform_real_distribution<float>(0, 1)(random) * Unit(&random), 1};
    const Vector3f normal = Unit(&random);
    double sum = 0;
    for (const Vector3f& d : directions) {
      sum += (node.mean + node.slope.dot(d)) * std::max(0.0f, normal.dot(d));
    }
    const double expected = sum * 4 * kPi / static_cast<double>(directions.size());
    EXPECT_NEAR(node.Irradiance(normal), expected, 2e-3 * expected);
  }
}

LightVolume::Node Linear(const Vector3f& at) {
  return {3 + 0.5f * at.x() - 0.2f * at.y() + 0.1f * at.z(),
          Vector3f(0.1f * at.z(), 0.3f, -0.2f * at.x()), 1};
}

TEST(LightVolume, ReproducesALinearFieldAndStaysAtItsBorderOutside) {
  const Eigen::AlignedBox3f box(Vector3f(-1, -2, 0), Vector3f(4, 2, 3));
  LightVolume volume(box, 0.75f);
  Eigen::AlignedBox3f nodes;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    nodes.extend(volume.Position(i));
    volume.Set(i, Linear(volume.Position(i)));
  }
  EXPECT_TRUE(nodes.contains(box)) << "the grid covers the box it was asked for";
  std::mt19937 random(2);
  std::uniform_real_distribution<float> share(-0.3f, 1.3f);
  for (int i = 0; i < 500; ++i) {
    const Vector3f at = nodes.min() + nodes.sizes().cwiseProduct(
                                          Vector3f(share(random), share(random), share(random)));
    const Vector3f held = at.cwiseMax(nodes.min()).cwiseMin(nodes.max());
    const LightVolume::Node got = volume.At(at), expected = Linear(held);
    EXPECT_NEAR(got.mean, expected.mean, 2e-3f) << at.transpose();
    EXPECT_LT((got.slope - expected.slope).norm(), 2e-3f);
  }
}

TEST(LightVolume, ShapesReachOverTheirBox) {
  const Eigen::AlignedBox3f box(Vector3f(-1, 2, 0), Vector3f(4, 2.2f, 3));
  for (const float spacing : {0.3f, 0.5f, 7.0f}) {
    const LightVolume volume(box, spacing);
    EXPECT_EQ(LightVolume::ShapeOf(box, spacing).size(), volume.size());
    const Vector3f last = volume.Position(volume.size() - 1);
    EXPECT_TRUE((last.array() >= box.max().array()).all()) << spacing;
    EXPECT_TRUE((last.array() <= box.max().array() + 2 * spacing).all()) << spacing;
    EXPECT_EQ(volume.Position(0), box.min());
  }
}

TEST(LightVolume, NodesInsideThingsDoNotDarkenWhatIsBesideThem) {
  LightVolume volume(Eigen::AlignedBox3f(Vector3f::Zero(), Vector3f::Ones()), 1.0f);
  for (std::size_t i = 0; i < volume.size(); ++i) volume.Set(i, {5, {1, 0, 0}, 1});
  for (std::size_t inside = 0; inside + 1 < volume.size(); ++inside) {
    volume.Set(inside, {0, Vector3f::Zero(), 0});  // one more each time
    const LightVolume::Node got = volume.At(Vector3f(0.9f, 0.95f, 0.9f));
    if (got.weight == 0) continue;
    EXPECT_NEAR(got.mean, 5, 1e-4f) << inside;
    EXPECT_NEAR(got.slope.x(), 1, 1e-4f);
  }
  EXPECT_EQ(volume.At(Vector3f(0.1f, 0.1f, 0.1f)).mean, 0) << "in the middle of a thing";
  EXPECT_EQ(LightVolume().At(Vector3f::Zero()).mean, 0);
}

}  // namespace
}  // namespace aisle::sim
