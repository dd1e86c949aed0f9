#include "simulator/shade/light/reflectance.h"

#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/surface/gloss.h"
#include "simulator/shade/surface/luminaires.h"

namespace aisle::sim {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Reflectance around a point, over `texel` metres.
float AlbedoAround(const World& world, const TexturePool& textures, const LightPoint& point,
                   float texel) {
  const TriangleMesh& mesh = world.statics().mesh;
  const Material& material = world.materials()[mesh.materials[point.triangle]];
  const auto& [a, b, c] = mesh.triangles[point.triangle];
  const Eigen::Vector2f uv =
      (1 - point.u - point.v) * mesh.uvs[a] + point.u * mesh.uvs[b] + point.v * mesh.uvs[c];
  const Eigen::Vector2f du = mesh.uvs[b] - mesh.uvs[a], dv = mesh.uvs[c] - mesh.uvs[a];
  const Eigen::Vector3f x = mesh.positions[b] - mesh.positions[a];
  const Eigen::Vector3f y = mesh.positions[c] - mesh.positions[a];
  const float world_area = x.cross(y).norm();
  const float uv_area = std::abs(du.x() * dv.y() - du.y() * dv.x());
  const float width = texel * std::sqrt(uv_area / std::max(world_area, 1e-9f));
  return material.albedo * textures.SampleWide(material.albedo_texture, uv.x(), uv.y(), width);
}

/// Share of diffuse light that a finish's lobe sends back, by Malley's measure 2 c dc of cosines.
float MeanGloss(const Finish& finish) {
  constexpr int kSteps = 64;
  if (finish.f0 <= 0) return 0;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float squared = (static_cast<float>(i) + 0.5f) / kSteps;
    sum += GlossShare(finish.f0, finish.roughness, std::sqrt(squared));
  }
  return sum / kSteps;
}

}  // namespace

std::vector<float> ReflectanceAt(const World& world, const TexturePool& textures,
                                 const LightGrid& grid, float texel) {
  std::vector<float> gloss, reflectance(grid.points.size());
  for (const Material& material : world.materials()) gloss.push_back(MeanGloss(FinishOf(material)));
  ParallelFor(std::size_t{0}, reflectance.size(), [&](std::size_t i) {
    const LightPoint& point = grid.points[i];
    const float mirrored = gloss[world.statics().mesh.materials[point.triangle]];
    reflectance[i] = (1 - mirrored) * AlbedoAround(world, textures, point, texel) + mirrored;
  });
  return reflectance;
}

bool HasSky(const World& world) {
  const std::vector<std::uint16_t>& materials = world.statics().mesh.materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (world.materials()[materials[i]].emission > 0 && !LightShown(world, i)) return true;
  }
  return false;
}

std::vector<float> EmittedAt(const World& world, const LightGrid& grid, float sky) {
  std::vector<float> emitted(grid.points.size());
  ParallelFor(std::size_t{0}, emitted.size(), [&](std::size_t i) {
    const std::uint32_t triangle = grid.points[i].triangle;
    const float emission = world.materials()[world.statics().mesh.materials[triangle]].emission;
    if (emission > 0 && !LightShown(world, triangle)) emitted[i] = kPi * emission * sky;
  });
  return emitted;
}

void PaintLuminaires(const World& world, const TexturePool& textures, const LightGrid& grid,
                     float texel, std::span<const float> light_scale, float sky,
                     LightState* state) {
  const TriangleMesh& mesh = world.statics().mesh;
  ParallelFor(std::size_t{0}, grid.patches.size(), [&](std::size_t i) {
    const Material& material = world.materials()[mesh.materials[i]];
    if (material.emission <= 0) return;
    const auto light = LightShown(world, i);
    const float emitted = material.emission * kPi * (light ? light_scale[*light] : sky);
    const auto first = static_cast<std::size_t>(grid.patches[i].slot);
    const std::size_t end = i + 1 < grid.patches.size()
                                ? static_cast<std::size_t>(grid.patches[i + 1].slot)
                                : grid.point_of_slot.size();
    float albedo = material.albedo;  // slots beyond the edge have that of the one before them
    for (std::size_t slot = first; slot < end; ++slot) {
      const std::uint32_t point = grid.point_of_slot[slot];
      if (point < LightGrid::kExtrapolated) {
        albedo = AlbedoAround(world, textures, grid.points[point], texel);
      }
      state->total[slot] = emitted + albedo * state->total[slot];
      state->direct[slot] *= albedo;
    }
  });
}

}  // namespace aisle::sim
