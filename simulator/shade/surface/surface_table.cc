#include "simulator/shade/surface/surface_table.h"

#include <Eigen/Geometry>

#include "simulator/shade/surface/gloss.h"

namespace aisle::sim {
namespace {

void Pose(const TriangleMesh& mesh, std::span<const Eigen::Vector3f> positions, std::size_t i,
          SurfaceRecord* record) {
  const auto& [a, b, c] = mesh.triangles[i];
  const Eigen::Vector3f e1 = positions[b] - positions[a], e2 = positions[c] - positions[a];
  const Eigen::Vector3f cross = e1.cross(e2);
  const float squared = std::max(cross.squaredNorm(), 1e-20f);
  const Eigen::Vector3f normal = cross / std::sqrt(squared);
  // Gradients of the barycentrics along the surface: g1·e1 = 1, g1·e2 = 0 and so on.
  const Eigen::Vector3f g1 = e2.cross(cross) / squared, g2 = cross.cross(e1) / squared;
  const Eigen::Vector3f du = g1 * record->uv1[0] + g2 * record->uv2[0];
  const Eigen::Vector3f dv = g1 * record->uv1[1] + g2 * record->uv2[1];
  for (int axis = 0; axis < 3; ++axis) {
    record->normal[axis] = normal[axis];
    record->du[axis] = du[axis];
    record->dv[axis] = dv[axis];
  }
}

}  // namespace

std::vector<SurfaceRecord> MakeSurfaceTable(const TriangleMesh& mesh,
                                            std::span<const Eigen::Vector3f> positions,
                                            std::span<const LightPatch> patches,
                                            std::span<const Material> materials,
                                            Luminaires luminaires) {
  std::vector<SurfaceRecord> table(mesh.triangles.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    SurfaceRecord& record = table[i];
    const auto& [a, b, c] = mesh.triangles[i];
    for (int axis = 0; axis < 2; ++axis) {
      record.uv0[axis] = mesh.uvs[a][axis];
      record.uv1[axis] = mesh.uvs[b][axis] - mesh.uvs[a][axis];
      record.uv2[axis] = mesh.uvs[c][axis] - mesh.uvs[a][axis];
    }
    const Material& material = materials[mesh.materials[i]];
    const bool luminaire = material.emission > 0 && luminaires == Luminaires::kShine;
    record.albedo = luminaire ? 1.0f : material.albedo;
    record.texture = luminaire ? -1 : material.albedo_texture;
    const Finish finish = FinishOf(material);
    record.f0 = luminaire ? -1.0f : finish.f0;
    record.roughness = finish.roughness;
    record.light = patches[i];
    Pose(mesh, positions, i, &record);
  }
  return table;
}

void PoseSurfaceTable(const TriangleMesh& mesh, std::span<const Eigen::Vector3f> positions,
                      std::span<SurfaceRecord> table) {
  for (std::size_t i = 0; i < table.size(); ++i) Pose(mesh, positions, i, &table[i]);
}

}  // namespace aisle::sim
