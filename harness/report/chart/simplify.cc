#include "harness/report/chart/simplify.h"

#include <algorithm>

namespace aisle {
namespace {

double SquaredDistance(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length = along.squaredNorm();
  const double at = length > 0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0;
  return (point - a - at * along).squaredNorm();
}

}  // namespace

std::vector<std::size_t> Simplify(const std::vector<Eigen::Vector3d>& points, double tolerance) {
  std::vector<std::size_t> kept;
  if (points.empty()) return kept;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double distance = tolerance * tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double here = SquaredDistance(points[i], points[first], points[last]);
      if (here <= distance) continue;
      distance = here;
      farthest = i;
    }
    if (farthest == first) continue;
    keep[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) kept.push_back(i);
  }
  return kept;
}

}  // namespace aisle
