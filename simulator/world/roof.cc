#include "simulator/world/forms.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// The hall's plan and height as the roofs need them.
struct Box {
  Vector2f low, size;
  float height;
};

void AddSkin(TriangleMesh* mesh, const Box& box, float tile_m, std::uint16_t material) {
  AddQuad(mesh, {box.low.x(), box.low.y(), box.height}, {box.size.x(), 0, 0}, {0, box.size.y(), 0},
          {{0, 0}, box.size / tile_m}, material);
}

void AddTrusses(TriangleMesh* mesh, const Box& box, const Palette& palette) {
  const auto& [low, size, height] = box;
  for (float x = low.x() + 2.5f; x < low.x() + size.x(); x += 5) {
    const float bottom = height - 0.55f, top = height - 0.12f;
    AddBar(mesh, {x, low.y(), bottom}, {x, low.y() + size.y(), bottom}, 0.14f, palette.steel);
    AddBar(mesh, {x, low.y(), top}, {x, low.y() + size.y(), top}, 0.14f, palette.steel);
    for (float y = low.y(); y + 0.8f < low.y() + size.y(); y += 1.6f) {
      AddBar(mesh, {x, y, bottom}, {x, y + 0.8f, top}, 0.06f, palette.steel);
      AddBar(mesh, {x, y + 0.8f, top}, {x, y + 1.6f, bottom}, 0.06f, palette.steel);
    }
  }
}

/// Steel frames with haunches, purlins over them, rods that brace the end bays, a sprinkler main.
void AddPortals(TriangleMesh* mesh, const Box& box, const Palette& palette) {
  constexpr float kDeep_m = 0.42f, kFrame_m = 6, kPurlin_m = 0.16f;
  const float south = box.low.y(), north = south + box.size.y();
  const float rafter = box.height - kPurlin_m - kDeep_m / 2 - 0.02f;
  const int bays = std::max(1, static_cast<int>(std::round(box.size.x() / kFrame_m)));
  const float bay = box.size.x() / static_cast<float>(bays);
  for (int i = 0; i <= bays; ++i) {
    const float inset = i == 0 ? 0.14f : i == bays ? -0.14f : 0;
    const float x = box.low.x() + bay * static_cast<float>(i) + inset;
    AddSection(mesh, {x, south, rafter}, {x, north, rafter}, Vector3f::UnitZ(), 0.2f, kDeep_m,
               0.016f, palette.steel);
    for (const float side : {-1.0f, 1.0f}) {
      const float foot = side < 0 ? south + 0.19f : north - 0.19f;
      AddSection(mesh, {x, foot, 0}, {x, foot, rafter}, Vector3f::UnitY(), 0.2f, 0.36f, 0.016f,
                 palette.steel);
      const Vector3f plate(0.3f, 0.38f, 0.03f);
      AddBox(mesh, At(x, foot, 0.015f), plate, BoxPaint::Tiled(palette.steel, plate, 1));
      AddSection(mesh, {x, foot - 0.1f * side, rafter - 0.75f},  // haunch
                 {x, foot - 1.4f * side, rafter - 0.1f}, Vector3f::UnitZ(), 0.19f, 0.18f, 0.014f,
                 palette.steel);
    }
  }
  for (float y = south + 0.7f; y < north; y += 1.5f) {
    AddSection(mesh, {box.low.x(), y, box.height - 0.1f},
               {box.low.x() + box.size.x(), y, box.height - 0.1f}, Vector3f::UnitZ(), 0.07f,
               kPurlin_m, 0.006f, palette.steel);
  }
  for (const int end : {0, bays - 1}) {
    const float x = box.low.x() + bay * static_cast<float>(end);
    AddTube(mesh, {{x, south + 0.05f, 0.3f}, {x + bay, south + 0.05f, rafter - 0.3f}}, 0.012f, 6,
            palette.steel);
    AddTube(mesh, {{x, north - 0.05f, rafter - 0.3f}, {x + bay, north - 0.05f, 0.3f}}, 0.012f, 6,
            palette.steel);
  }
  const float main = rafter - kDeep_m / 2 - 0.12f, middle = (south + north) / 2 + 0.9f;
  AddTube(mesh, {{box.low.x(), middle, main}, {box.low.x() + box.size.x(), middle, main}}, 0.045f,
          12, palette.stripes);
  for (float x = box.low.x() + 1.5f; x < box.low.x() + box.size.x(); x += 3) {
    AddTube(mesh, {{x, south + 1, main - 0.06f}, {x, north - 1, main - 0.06f}}, 0.018f, 8,
            palette.stripes);
  }
}

/// A ceiling of panels: the joints are the sheet's; rails hang them from what is above.
void AddPanelRails(TriangleMesh* mesh, const Box& box, const Palette& palette) {
  for (float x = box.low.x() + 3.2f; x < box.low.x() + box.size.x() - 1; x += 5.75f) {
    const Vector3f rail(0.12f, box.size.y(), 0.035f);
    AddBox(mesh, At(x, box.low.y() + box.size.y() / 2, box.height - 0.018f), rail,
           BoxPaint::Tiled(palette.lamp_housing, rail, 1));
  }
}

/// Precast concrete: main beams across, ribs from one to the next.
void AddRibs(TriangleMesh* mesh, const Box& box, const Palette& palette) {
  const float south = box.low.y(), north = south + box.size.y();
  const int bays = std::max(1, static_cast<int>(std::round(box.size.x() / 7.5f)));
  const float bay = box.size.x() / static_cast<float>(bays);
  for (int i = 1; i < bays; ++i) {
    const float x = box.low.x() + bay * static_cast<float>(i);
    const Vector3f beam(0.4f, box.size.y(), 0.75f);
    AddRounded(mesh, At(x, (south + north) / 2, box.height - 0.375f), beam, 0.03f, palette.roof, 4,
               {0.3f * static_cast<float>(i), 0});
  }
  for (float y = south + 0.6f; y < north; y += 1.2f) {
    const Vector3f rib(box.size.x(), 0.14f, 0.38f);
    AddBox(mesh, At(box.low.x() + box.size.x() / 2, y, box.height - 0.19f), rib,
           BoxPaint::Tiled(palette.roof, rib, 4, {0, 0.13f * y}));
  }
}

}  // namespace

void AddRoof(const Scene& scene, const Palette& palette, WorldBuilder* builder) {
  const HallSpec& hall = scene.hall;
  if (hall.walls == WallKind::kSky) return;
  const Box box = {hall.from.cast<float>(), (hall.to - hall.from).cast<float>(),
                   static_cast<float>(hall.height_m)};
  builder->Add("roof", ObjectClass::kWall, [&](TriangleMesh* mesh) {
    AddSkin(mesh, box, 4, palette.roof);
    switch (hall.roof) {
      case RoofKind::kTrusses:
        return AddTrusses(mesh, box, palette);
      case RoofKind::kPortal:
        return AddPortals(mesh, box, palette);
      case RoofKind::kFlat:
        return AddPanelRails(mesh, box, palette);
      case RoofKind::kRibs:
        return AddRibs(mesh, box, palette);
    }
  });
}

}  // namespace aisle::sim
