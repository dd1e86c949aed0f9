#include "simulator/shade/lanes/hemisphere.h"

#include <gtest/gtest.h>

namespace aisle::sim {
namespace {

/// Moments over the hemisphere with density cos / π: E z = 2/3, E z² = 1/2, E x² = E y² = 1/4, and
/// nothing leans to a side.
TEST(CosineDirections, HaveTheMomentsOfTheCosine) {
  for (const int count : {64, 256, 4096}) {
    const double slack = 4.0 / count;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3f& d : CosineDirections(count)) {
      EXPECT_NEAR(d.norm(), 1, 1e-6);
      EXPECT_GE(d.z(), 0);
      mean += d.cast<double>() / count;
      second += d.cast<double>() * d.cast<double>().transpose() / count;
    }
    EXPECT_LT((mean - Eigen::Vector3d(0, 0, 2.0 / 3)).norm(), slack) << count;
    const Eigen::Vector3d expected(0.25, 0.25, 0.5);
    EXPECT_LT((second - Eigen::Matrix3d(expected.asDiagonal())).norm(), slack) << count;
  }
}

TEST(SphereDirections, AreEvenOverTheSphere) {
  for (const int count : {64, 256, 4096}) {
    const double slack = 6.0 / count;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3f& d : SphereDirections(count)) {
      EXPECT_NEAR(d.norm(), 1, 1e-6);
      mean += d.cast<double>() / count;
      second += d.cast<double>() * d.cast<double>().transpose() / count;
    }
    EXPECT_LT(mean.norm(), slack) << count;
    EXPECT_LT((second - Eigen::Matrix3d::Identity() / 3).norm(), slack) << count;
  }
}

/// How far the share of points in any box [0, a] × [0, b] is from its area: random points would
/// err by about 1 / √n.
double StarDiscrepancy(int first, int count) {
  double worst = 0;
  for (double a = 0.05; a <= 1; a += 0.05) {
    for (double b = 0.05; b <= 1; b += 0.05) {
      int inside = 0;
      for (int i = first; i < first + count; ++i) {
        const Eigen::Vector2f p = SpreadPoint(i);
        inside += p.x() < a && p.y() < b;
      }
      worst = std::max(worst, std::abs(static_cast<double>(inside) / count - a * b));
    }
  }
  return worst;
}

TEST(SpreadPoints, FillTheSquareMoreEvenlyThanChanceFromAnyStart) {
  for (const int first : {0, 17, 5000, 65'000}) {
    for (const int count : {16, 64, 256, 1024}) {
      EXPECT_LT(StarDiscrepancy(first, count), 3.0 / std::pow(count, 0.85))
          << first << " " << count;
    }
    for (int i = first; i < first + 1000; ++i) {
      const Eigen::Vector2f p = SpreadPoint(i);
      EXPECT_GE(p.minCoeff(), 0);
      EXPECT_LE(p.maxCoeff(), 1) << "the closed square: a share just below 1 rounds to 1";
    }
  }
}

}  // namespace
}  // namespace aisle::sim
