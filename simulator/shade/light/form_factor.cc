#include "simulator/shade/light/form_factor.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace aisle::sim {
namespace {

using Eigen::Vector3d;

/// A rectangle cut by a plane has at most one corner more.
struct Polygon {
  std::array<Vector3d, 5> corners;
  std::size_t count = 0;

  void Add(const Vector3d& corner) { corners[count++] = corner; }
};

Polygon AboveHorizon(const std::array<Vector3d, 4>& rectangle, const Vector3d& normal) {
  Polygon above;
  for (std::size_t i = 0; i < rectangle.size(); ++i) {
    const Vector3d &a = rectangle[i], &b = rectangle[(i + 1) % rectangle.size()];
    const double height_a = a.dot(normal), height_b = b.dot(normal);
    if (height_a >= 0) above.Add(a);
    if ((height_a >= 0) != (height_b >= 0)) {
      above.Add(a + height_a / (height_a - height_b) * (b - a));
    }
  }
  return above;
}

}  // namespace

float UnshadowedIrradiance(const AreaLight& light, const SurfacePoint& place) {
  const Vector3d normal = place.normal.cast<double>();
  const Vector3d center = (light.center - place.position).cast<double>();
  const Vector3d u = light.half_u.cast<double>(), v = light.half_v.cast<double>();
  if (center.dot(u.cross(v)) >= 0) return 0;
  const Polygon seen =
      AboveHorizon({center - u - v, center - u + v, center + u + v, center + u - v}, normal);
  double sum = 0;
  for (std::size_t i = 0; i < seen.count; ++i) {
    const Vector3d &a = seen.corners[i], &b = seen.corners[(i + 1) % seen.count];
    const Vector3d cross = a.cross(b);
    const double sine = cross.norm();
    if (sine > 0) sum += std::atan2(sine, a.dot(b)) * cross.dot(normal) / sine;
  }
  return static_cast<float>(std::max(0.0, sum / 2) * light.radiance);
}

}  // namespace aisle::sim
