#include "harness/report/chart/simplify.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

TEST(SimplifyTest, WhatIsLeftOutIsNearWhatIsDrawn) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(i, 20 * std::sin(0.05 * i) + i % 3, 0);
  const std::vector<std::size_t> kept = Simplify(points, 1.5);
  EXPECT_EQ(kept.front(), 0u);
  EXPECT_EQ(kept.back(), points.size() - 1);
  EXPECT_LT(kept.size(), points.size() / 3);
  for (std::size_t k = 1; k < kept.size(); ++k) {
    const Eigen::ParametrizedLine<double, 3> line =
        Eigen::ParametrizedLine<double, 3>::Through(points[kept[k - 1]], points[kept[k]]);
    for (std::size_t i = kept[k - 1]; i < kept[k]; ++i) {
      EXPECT_LE(line.distance(points[i]), 1.5 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace aisle
