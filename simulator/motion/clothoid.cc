#include "simulator/motion/clothoid.h"

#include <cmath>

namespace aisle::sim {
namespace {

/// Positive half of the 12-point Gauss-Legendre rule on [-1, 1]. Its error on exp(i phi(s)) falls
/// with the 24th power of the turn: below 1e-16 of the distance for half a turn of an arc, and of
/// a clothoid from or to a line.
struct Node {
  double at, weight;
};
constexpr Node kNodes[] = {
    {0.12523340851146891, 0.24914704581340277}, {0.36783149899818018, 0.23349253653835481},
    {0.58731795428661748, 0.20316742672306592}, {0.76990267419430469, 0.16007832854334622},
    {0.90411725637047491, 0.10693932599531843}, {0.98156063424671924, 0.047175336386511828}};

Eigen::Vector2d Direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

PathPoint AlongArc(const PathPoint& start, double distance) {
  const double k = start.curvature_per_m;
  const double half = k * distance / 2;
  // The chord of an arc: length s·sinc(ks/2), direction half-way through the turn.
  const double chord = std::abs(half) < 1e-9 ? distance : distance * std::sin(half) / half;
  return {start.position + chord * Direction(start.heading_rad + half),
          start.heading_rad + k * distance, k};
}

}  // namespace

PathPoint AlongClothoid(const PathPoint& start, double sharpness, double distance) {
  if (sharpness == 0) return AlongArc(start, distance);
  const auto heading = [&](double s) {
    return start.heading_rad + (start.curvature_per_m + sharpness * s / 2) * s;
  };
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Node& node : kNodes) {
    const double before = distance * (1 - node.at) / 2, after = distance * (1 + node.at) / 2;
    sum += node.weight * (Direction(heading(before)) + Direction(heading(after)));
  }
  return {start.position + distance / 2 * sum, heading(distance),
          start.curvature_per_m + sharpness * distance};
}

}  // namespace aisle::sim
