#include "simulator/shade/surface/luminaires.h"

#include <algorithm>

namespace aisle::sim {

std::optional<std::size_t> LightShown(const World& world, std::size_t triangle) {
  constexpr float kDeepest = 0.3f;  // m
  const TriangleMesh& mesh = world.statics().mesh;
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3f middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3;
  std::optional<std::size_t> best;
  float nearest = kDeepest;
  for (std::size_t i = 0; i < world.lights().size(); ++i) {
    const AreaLight& light = world.lights()[i];
    const Eigen::Vector3f d = middle - light.center;
    const auto along = [&](const Eigen::Vector3f& half) {
      return std::clamp(d.dot(half) / half.squaredNorm(), -1.0f, 1.0f);
    };
    const float distance =
        (d - along(light.half_u) * light.half_u - along(light.half_v) * light.half_v).norm();
    if (distance < nearest) {
      nearest = distance;
      best = i;
    }
  }
  return best;
}

}  // namespace aisle::sim
