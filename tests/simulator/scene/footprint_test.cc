#include "simulator/scene/footprint.h"

#include <gtest/gtest.h>

#include <numbers>

namespace aisle::sim {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

RouteState At(double x, double y, double heading_rad = 0) {
  RouteState state;
  state.position = {x, y};
  state.heading_rad = heading_rad;
  return state;
}

/// The same by looking at many pairs of points.
double BruteApart(const Footprint& one, const RouteState& a, const Footprint& other,
                  const RouteState& b) {
  constexpr int kSteps = 400;
  const auto point = [](const Footprint& f, const RouteState& s, int i) -> Eigen::Vector2d {
    const double along = f.back_m + (f.front_m - f.back_m) * i / kSteps;
    return s.position + along * Eigen::Vector2d(std::cos(s.heading_rad), std::sin(s.heading_rad));
  };
  double apart = 1e9;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      apart = std::min(apart, (point(one, a, i) - point(other, b, k)).norm());
    }
  }
  return apart;
}

TEST(Apart, IsTheLeastDistanceOfAnyTwoPoints) {
  const Footprint car = FootprintOf("car_red"), truck = FootprintOf("forklift_driver");
  for (int i = 0; i < 60; ++i) {
    const RouteState a = At(0.3 * (i % 7), 0.2 * (i % 5), 0.37 * i);
    const RouteState b = At(4 - 0.2 * (i % 11), 2.5 - 0.3 * (i % 3), 1.1 * i);
    const double apart = Apart(car, a, truck, b);
    EXPECT_NEAR(apart, BruteApart(car, a, truck, b), 0.02) << i;
    EXPECT_DOUBLE_EQ(apart, Apart(truck, b, car, a));
  }
}

TEST(Apart, OfLinesThatCrossIsNothing) {
  const Footprint line = {-1, 1, 0.2};
  EXPECT_EQ(Apart(line, At(0, 0), line, At(0.3, 0.1, kHalfTurn / 2)), 0);
}

TEST(Apart, OfTwoPointsIsTheirDistance) {
  const Footprint person = {0, 0, 0.22};
  EXPECT_DOUBLE_EQ(Apart(person, At(0, 0), person, At(3, 4)), 5);
}

}  // namespace
}  // namespace aisle::sim
