#include "simulator/world/fittings.h"

#include <cmath>
#include <numbers>

#include "simulator/scene/fixture.h"
#include "simulator/world/sheets.h"

namespace aisle::sim {

Fittings AddFittings(const AssetLibrary& assets, WorldParts* parts) {
  const auto add = [&](const char* name, float albedo, float f0, float roughness,
                       const char* picture = nullptr) {
    Material material;
    material.name = name;
    material.albedo = albedo;
    material.specular_f0 = f0;
    material.roughness = roughness;
    if (picture != nullptr) {
      material.albedo_texture = static_cast<int>(parts->textures.size());
      parts->textures.push_back({picture, assets.Picture(picture)});
    }
    parts->materials.push_back(std::move(material));
    return static_cast<std::uint16_t>(parts->materials.size() - 1);
  };
  Fittings f;
  f.enamel = add("enamel", 1, 0.04f, 0.4f, "enamel");
  f.dark = add("dark_paint", 0.035f, 0.04f, 0.45f);
  f.rubber = add("rubber", 0.045f, 0.02f, 0.7f);
  f.chrome = add("bright_steel", 0.42f, 0.3f, 0.32f);
  f.glass = add("dark_glass", 0.03f, 0.05f, 0.08f);
  f.white = add("white_sheet", 0.74f, 0.04f, 0.4f);
  f.brass = add("brass", 0.3f, 0.2f, 0.35f);
  f.panel = add("cold_panel", 1, 0.04f, 0.4f, "wall_insulated");
  f.pvc = add("strip_pvc", 0.9f, 0.05f, 0.22f, "strip_pvc");
  f.checker = add("checker_plate", 1, 0.06f, 0.45f, "checker_plate");
  f.peg = add("pegboard", 1, 0.04f, 0.5f, "pegboard");
  f.fins = add("fins", 0.16f, 0.05f, 0.5f);
  f.film = add("stretch_film", 0.6f, 0.06f, 0.15f);
  f.puddle = add("puddle", 0.06f, 0.03f, 0.03f);
  f.oil = add("oil", 0.025f, 0.045f, 0.1f);
  f.chalk = add("chalk", 0.5f, 0, 1);
  f.dust = add("dust", 0.33f, 0, 1);
  f.card = add("card", 0.33f, 0, 1);
  return f;
}

void Maker::Ring(const Eigen::Vector3f& middle, const Eigen::Vector3f& axis, float radius,
                 float bar, std::uint16_t material, int parts) const {
  const Eigen::Vector3f a = axis.unitOrthogonal(), b = axis.normalized().cross(a);
  std::vector<Eigen::Vector3f> way;
  for (int i = 0; i <= parts; ++i) {
    const float angle =
        2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(parts);
    way.push_back(middle + radius * (std::cos(angle) * a + std::sin(angle) * b));
  }
  Pipe(way, bar, material, 6);
}

namespace {

const char* NameOf(FixtureKind kind) {
  constexpr std::array kNames = {
      "strip_curtain", "panel_wall", "evaporator", "lathe",    "mill",        "drill",
      "bench",         "tool_wall",  "tool_cart",  "locker",   "gas_bottles", "duct",
      "cable_tray",    "cable_drop", "crane",      "leveller", "guide_rail"};
  return kNames[static_cast<std::size_t>(kind)];
}

void Draw(FixtureKind kind, const Maker& make, const Eigen::Vector3f& size, float roof,
          const Dice& dice) {
  switch (kind) {
    case FixtureKind::kStripCurtain:
      return AddStripCurtain(make, size, dice);
    case FixtureKind::kPanelWall:
      return AddPanelWall(make, size, dice);
    case FixtureKind::kEvaporator:
      return AddEvaporator(make, size, roof, dice);
    case FixtureKind::kLathe:
      return AddLathe(make, size, dice);
    case FixtureKind::kMill:
      return AddMill(make, size, dice);
    case FixtureKind::kDrill:
      return AddDrill(make, size, dice);
    case FixtureKind::kBench:
      return AddBench(make, size, dice);
    case FixtureKind::kToolWall:
      return AddToolWall(make, size, dice);
    case FixtureKind::kToolCart:
      return AddToolCart(make, size, dice);
    case FixtureKind::kLocker:
      return AddLocker(make, size, dice);
    case FixtureKind::kGasBottles:
      return AddGasBottles(make, size, dice);
    case FixtureKind::kDuct:
      return AddDuct(make, size, roof, dice);
    case FixtureKind::kCableTray:
      return AddCableTray(make, size, roof, dice);
    case FixtureKind::kCableDrop:
      return AddCableDrop(make, size, roof, dice);
    case FixtureKind::kCrane:
      return AddCrane(make, size, roof, dice);
    case FixtureKind::kLeveller:
      return AddLeveller(make, size, dice);
    case FixtureKind::kGuideRail:
      return AddGuideRail(make, size, dice);
  }
}

}  // namespace

void AddFixtures(const Scene& scene, const Kit& kit, std::uint64_t seed, WorldBuilder* builder) {
  for (std::size_t i = 0; i < scene.fixtures.size(); ++i) {
    const FixtureSpec& fixture = scene.fixtures[i];
    const Eigen::Vector2f at = fixture.at.cast<float>();
    const Eigen::Isometry3f pose = At(at.x(), at.y(), 0, static_cast<float>(fixture.heading_rad));
    const ObjectClass kind = fixture.kind == FixtureKind::kPanelWall  ? ObjectClass::kWall
                             : fixture.kind == FixtureKind::kLeveller ? ObjectClass::kFloor
                                                                      : ObjectClass::kFurniture;
    builder->Add(fmt::format("{}_{}", NameOf(fixture.kind), i), kind, [&](TriangleMesh* mesh) {
      Draw(fixture.kind, Maker(kit, pose, mesh), SizeOf(fixture).cast<float>(),
           static_cast<float>(scene.hall.height_m), Dice(seed, {340, i}));
    });
  }
}

}  // namespace aisle::sim
