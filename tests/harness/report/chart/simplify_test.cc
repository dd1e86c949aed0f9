#include "harness/report/chart/simplify.h"

#include <gtest/gtest.h>

#include <random>

namespace aisle {
namespace {

double DistanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const double length = (b - a).squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - share * (b - a)).norm();
}

std::vector<Eigen::Vector3d> Walk(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::normal_distribution<double> step;
  std::vector<Eigen::Vector3d> points{Eigen::Vector3d::Zero()};
  while (points.size() < count) {
    const Eigen::Vector3d way(step(random), step(random), seed % 2 ? 0 : step(random));
    // Some stand, some turn back: both are hard on a simplifier.
    points.push_back(points.back() + (random() % 5 == 0 ? Eigen::Vector3d::Zero() : way));
  }
  return points;
}

/// By trying every point against the very piece that is drawn over it.
TEST(Simplify, WhatIsLeftOutIsNearWhatIsDrawn) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const std::vector<Eigen::Vector3d> points = Walk(seed, 2 + 7 * seed);
    for (const double tolerance : {0.0, 0.1, 1.0, 10.0}) {
      const std::vector<std::size_t> kept = Simplify(points, tolerance);
      ASSERT_GE(kept.size(), 2u);
      EXPECT_EQ(kept.front(), 0u);
      EXPECT_EQ(kept.back(), points.size() - 1);
      for (std::size_t k = 1; k < kept.size(); ++k) {
        ASSERT_GT(kept[k], kept[k - 1]);
        for (std::size_t i = kept[k - 1]; i < kept[k]; ++i) {
          EXPECT_LE(DistanceToSegment(points[i], points[kept[k - 1]], points[kept[k]]),
                    tolerance + 1e-9)
              << seed;
        }
      }
    }
  }
}

TEST(Simplify, MoreToleranceKeepsNoMoreAndSmoothLinesKeepLittle) {
  std::vector<Eigen::Vector3d> wave, straight;
  for (int i = 0; i < 500; ++i) {
    wave.emplace_back(i, 20 * std::sin(0.05 * i) + i % 3, 0);
    straight.emplace_back(2 * i, 3 * i, -i);
  }
  EXPECT_LT(Simplify(wave, 1.5).size(), wave.size() / 3);
  EXPECT_EQ(Simplify(straight, 1e-6).size(), 2u);
  std::size_t before = wave.size() + 1;
  for (const double tolerance : {0.01, 0.5, 2.0, 8.0, 100.0}) {
    const std::size_t now = Simplify(wave, tolerance).size();
    EXPECT_LE(now, before);
    before = now;
  }
}

TEST(Simplify, FewPointsAreAllKept) {
  EXPECT_TRUE(Simplify({}, 1).empty());
  EXPECT_EQ(Simplify({{1, 2, 3}}, 1), std::vector<std::size_t>{0});
  EXPECT_EQ(Simplify({{1, 2, 3}, {1, 2, 3}}, 1), (std::vector<std::size_t>{0, 1}));
}

}  // namespace
}  // namespace aisle
