#include "simulator/shade/surface/normal_map.h"

#include <Eigen/Geometry>

namespace aisle::sim {

Eigen::Vector3f SmoothNormal(const MeshPlace& place) {
  const auto& [a, b, c] = place.topology.triangles[place.triangle];
  return ((1 - place.u - place.v) * place.normals[a] + place.u * place.normals[b] +
          place.v * place.normals[c])
      .normalized();
}

std::optional<MapAxes> AxesOfMap(const MeshPlace& place, const Material& material, float width_m) {
  if (material.normal_texture < 0) return std::nullopt;
  const Eigen::Vector3f normal = SmoothNormal(place);
  const auto& [a, b, c] = place.topology.triangles[place.triangle];
  const std::vector<Eigen::Vector2f>& uvs = place.topology.uvs;
  const Eigen::Vector3f e1 = place.positions[b] - place.positions[a];
  const Eigen::Vector3f e2 = place.positions[c] - place.positions[a];
  const Eigen::Vector2f d1 = uvs[b] - uvs[a], d2 = uvs[c] - uvs[a];
  const float area = d1.x() * d2.y() - d2.x() * d1.y();
  if (std::abs(area) < 1e-12f) return std::nullopt;
  const Eigen::Vector3f along_u = (e1 * d2.y() - e2 * d1.y()) / area;
  const Eigen::Vector3f along_v = (e2 * d1.x() - e1 * d2.x()) / area;
  const Eigen::Vector3f flat = along_u - normal * normal.dot(along_u);
  const float length = flat.norm();
  if (length < 1e-9f) return std::nullopt;
  const Eigen::Vector3f tangent = flat / length, across = normal.cross(tangent);
  const float up = across.dot(along_v) > 0 ? -1.0f : 1.0f;
  const Eigen::Vector2f uv = uvs[a] + place.u * d1 + place.v * d2;
  return MapAxes{
      normal, tangent, up * across, {material.normal_texture, uv.x(), uv.y(), width_m / length}};
}

Eigen::Vector3f BentNormal(const MapAxes& axes, const Eigen::Vector2f& bend, float scale) {
  const float rest = std::sqrt(std::max(0.0f, 1 - bend.squaredNorm()));
  const Eigen::Vector2f scaled = scale * bend;
  return (scaled.x() * axes.right + scaled.y() * axes.upward + rest * axes.smooth).normalized();
}

Eigen::Vector3f MappedNormal(const MeshPlace& place, const Material& material,
                             const TexturePool& textures, float width_m) {
  const std::optional<MapAxes> axes = AxesOfMap(place, material, width_m);
  if (!axes) return SmoothNormal(place);
  return BentNormal(*axes, textures.SampleNormal(axes->point), material.normal_scale);
}

}  // namespace aisle::sim
