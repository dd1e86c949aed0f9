#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

/// Housing of a luminaire around its shining underside.
void AddLuminaire(TriangleMesh* mesh, const Vector3f& middle, const Vector3f& half_u,
                  const Vector3f& half_v, float roof, std::uint16_t lamp, const Palette& palette) {
  const Vector3f size(2 * half_u.x() + 0.06f, -2 * half_v.y() + 0.06f, 0.09f);
  BoxPaint housing = BoxPaint::Whole(palette.lamp_housing);
  AddBox(mesh, At(middle.x(), middle.y(), middle.z() + 0.055f), size, housing);
  AddQuad(mesh, middle - half_u + half_v, 2 * half_u, -2 * half_v, {}, lamp);
  for (const float side : {-0.8f, 0.8f}) {
    const Vector3f top = middle + side * half_u;
    AddBar(mesh, top + Vector3f(0, 0, 0.1f), {top.x(), top.y(), roof}, 0.02f, palette.steel);
  }
}

}  // namespace

void AddLights(const Scene& scene, const Palette& palette, WorldParts* parts,
               WorldBuilder* builder) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const LightsSpec& grid = scene.lights[i];
    const Eigen::Vector2f low = grid.from.value_or(scene.hall.from).cast<float>();
    const Eigen::Vector2f high = grid.to.value_or(scene.hall.to).cast<float>();
    const Vector3f half_u(static_cast<float>(grid.size_m.x()) / 2, 0, 0);
    const Vector3f half_v(0, -static_cast<float>(grid.size_m.y()) / 2, 0);  // u × v looks down
    builder->Add(fmt::format("lights_{}", i), ObjectClass::kLuminaire, [&](TriangleMesh* mesh) {
      for (int k = 0; k < grid.rows * grid.per_row; ++k) {
        const Eigen::Vector2f share(
            (static_cast<float>(k % grid.per_row) + 0.5f) / static_cast<float>(grid.per_row),
            (static_cast<float>(k / grid.per_row) + 0.5f) / static_cast<float>(grid.rows));
        const Eigen::Vector2f at = low + (high - low).cwiseProduct(share);
        const Vector3f middle(at.x(), at.y(), static_cast<float>(grid.height_m));
        if (scene.hall.walls == WallKind::kSky) {
          AddQuad(mesh, middle - half_u + half_v, 2 * half_u, -2 * half_v, {}, palette.lamps[i]);
        } else {
          AddLuminaire(mesh, middle, half_u, half_v, static_cast<float>(scene.hall.height_m),
                       palette.lamps[i], palette);
        }
        parts->lights.push_back({middle, half_u, half_v, static_cast<float>(grid.brightness)});
      }
    });
  }
  for (const DoorSpec& door : scene.doors) {
    if (door.daylight <= 0) continue;
    for (const AreaLight& light : DaylightOf(scene.hall, door)) parts->lights.push_back(light);
  }
}

std::vector<float> LightScale(const Scene& scene, double time_s) {
  std::vector<float> scale;
  for (const LightsSpec& grid : scene.lights) {
    const bool dark = std::ranges::any_of(
        grid.off, [&](const Blackout& off) { return time_s >= off.from_s && time_s < off.to_s; });
    scale.insert(scale.end(), static_cast<std::size_t>(grid.rows * grid.per_row),
                 dark ? 0.0f : 1.0f);
  }
  for (const DoorSpec& door : scene.doors) {
    if (door.daylight > 0) scale.insert(scale.end(), kLightsOfDoor, CloudAt(scene.hall, time_s));
  }
  // Windows shine as the sky behind them does.
  scale.insert(
      scale.end(),
      static_cast<std::size_t>(std::ranges::count(scene.beams, BeamKind::kSun, &BeamSpec::kind)),
      1.0f);
  return scale;
}

}  // namespace aisle::sim
