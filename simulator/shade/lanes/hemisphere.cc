#include "simulator/shade/lanes/hemisphere.h"

#include <cmath>
#include <numbers>

namespace aisle::sim {

constexpr float kPi = std::numbers::pi_v<float>;

Eigen::Vector2f SpreadPoint(int i) {
  const auto x = 0.5 + 0.7548776662466927 * (i + 1), y = 0.5 + 0.5698402909980532 * (i + 1);
  return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

std::vector<Eigen::Vector3f> CosineDirections(int count) {
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2f s = SpreadPoint(i);
    const float r = std::sqrt(s.x()), phi = 2 * kPi * s.y();
    directions.emplace_back(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - s.x()));
  }
  return directions;
}

std::vector<Eigen::Vector3f> SphereDirections(int count) {
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2f s = SpreadPoint(i);
    const float z = 1 - 2 * s.x(), r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * s.y();
    directions.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return directions;
}

Eigen::Matrix3f BasisAround(const Eigen::Vector3f& n) {
  const float sign = std::copysign(1.0f, n.z());
  const float a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  Eigen::Matrix3f basis;
  basis.col(0) = Eigen::Vector3f(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
  basis.col(1) = Eigen::Vector3f(b, sign + n.y() * n.y() * a, -n.y());
  basis.col(2) = n;
  return basis;
}

void SetRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float t_far, int k,
            Rays8* rays) {
  rays->ox[k] = origin.x();
  rays->oy[k] = origin.y();
  rays->oz[k] = origin.z();
  rays->dx[k] = direction.x();
  rays->dy[k] = direction.y();
  rays->dz[k] = direction.z();
  rays->t_near[k] = 0;
  rays->t_far[k] = t_far;
  rays->valid[k] = -1;
}

}  // namespace aisle::sim
