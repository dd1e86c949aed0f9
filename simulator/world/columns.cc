#include "simulator/world/forms.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

/// A rolled section on a bolted plate, angles that take the knocks.
void AddSteelColumn(TriangleMesh* mesh, const Eigen::Vector2f& at, float half, float height,
                    const ColumnSpec& column, const Palette& palette) {
  AddSection(mesh, {at.x(), at.y(), 0.02f}, {at.x(), at.y(), height}, Eigen::Vector3f::UnitX(),
             2 * half, 2 * half, 0.022f, palette.steel);
  const Eigen::Vector3f plate(2 * half + 0.14f, 2 * half + 0.14f, 0.03f);
  AddBox(mesh, At(at.x(), at.y(), 0.015f), plate, BoxPaint::Tiled(palette.steel, plate, 1));
  for (const float x : {-half - 0.03f, half + 0.03f}) {
    for (const float y : {-half - 0.03f, half + 0.03f}) {
      AddTube(mesh, {{at.x() + x, at.y() + y, 0.03f}, {at.x() + x, at.y() + y, 0.07f}}, 0.014f, 6,
              palette.steel);
      if (!column.striped) continue;
      AddRounded(mesh, At(at.x() + 0.86f * x, at.y() + 0.86f * y, 0.6f), {0.07f, 0.07f, 1.1f},
                 0.02f, palette.stripes, 0.5f);
    }
  }
}

/// Cast concrete, painted up to the height of a load.
void AddRoundColumn(TriangleMesh* mesh, const Eigen::Vector2f& at, float half, float height,
                    const ColumnSpec& column, const Palette& palette) {
  const float painted = column.striped ? 1.5f : 0;
  AddTurned(mesh, At(at.x(), at.y(), 0),
            {{half + 0.004f, painted},
             {half, painted + 0.004f},
             {half, height - 0.4f},
             {1.7f * half, height - 0.04f},
             {1.7f * half, height}},
            32, palette.plinth, 2);
  if (painted == 0) return;
  AddTurned(mesh, At(at.x(), at.y(), 0),
            {{half + 0.03f, 0},
             {half + 0.03f, 0.1f},
             {half + 0.006f, 0.13f},
             {half + 0.006f, painted},
             {half - 0.01f, painted}},
            32, palette.stripes, 0.5f);
}

}  // namespace

void AddColumns(const Scene& scene, const Palette& palette, WorldBuilder* builder) {
  for (std::size_t i = 0; i < scene.columns.size(); ++i) {
    const ColumnSpec& column = scene.columns[i];
    const float half = static_cast<float>(column.size_m) / 2;
    const Eigen::Vector2f at = column.at.cast<float>();
    const float height = static_cast<float>(scene.hall.height_m);
    const float striped = column.striped ? 1.4f : 0;
    builder->Add(fmt::format("column_{}", i), ObjectClass::kColumn, [&](TriangleMesh* mesh) {
      if (column.kind == ColumnKind::kSteel) {
        return AddSteelColumn(mesh, at, half, height, column, palette);
      }
      if (column.kind == ColumnKind::kRound) {
        return AddRoundColumn(mesh, at, half, height, column, palette);
      }
      const auto block = [&](float from, float to, float wide, std::uint16_t material, float tile) {
        const Eigen::Vector3f size(2 * wide, 2 * wide, to - from);
        AddBox(mesh, At(at.x(), at.y(), (from + to) / 2), size,
               BoxPaint::Tiled(material, size, tile,
                               {0.3f * static_cast<float>(i), 0.17f * static_cast<float>(i)}));
      };
      if (striped > 0) block(0, striped, half + 0.015f, palette.stripes, 0.5f);
      block(striped, height, half, palette.steel, 1.2f);
      block(0, 0.12f, half + 0.06f, palette.plinth, 1);
      const Eigen::Vector3f sign(2 * half + 0.08f, 0.4f, 0.4f);
      AddBox(mesh, At(at.x(), at.y(), 2.3f), sign,
             BoxPaint::Whole(palette.sign, palette.aisle_signs[i % kAisleSigns]));
    });
  }
}

}  // namespace aisle::sim
