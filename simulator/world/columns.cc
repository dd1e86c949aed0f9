#include "simulator/world/warehouse.h"

namespace aisle::sim {

void AddColumns(const Scene& scene, const Palette& palette, Site* site) {
  for (std::size_t i = 0; i < scene.columns.size(); ++i) {
    const ColumnSpec& column = scene.columns[i];
    const float half = static_cast<float>(column.size_m) / 2;
    const Eigen::Vector2f at = column.at.cast<float>();
    const float height = static_cast<float>(scene.hall.height_m);
    const float striped = column.striped ? 1.4f : 0;
    site->Add(fmt::format("column_{}", i), ObjectClass::kColumn, [&](TriangleMesh* mesh) {
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
