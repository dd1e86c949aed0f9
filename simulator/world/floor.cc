#include <cmath>

#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Paint lies this high over the floor, so that rays tell them apart.
constexpr float kPaint_m = 0.0012f;

/// One slab, its sheet turned by a multiple of 90° or mirrored: eight looks a sheet.
void AddSlab(TriangleMesh* mesh, const Vector2f& low, const Vector2f& high, std::uint16_t material,
             Dice dice) {
  const Vector2f size = (high - low) / kFloorSheet_m;
  const bool swap = dice.Chance(0.5);
  UvRect uv;
  const bool mirror_y = !dice.Chance(0.5), mirror_x = !dice.Chance(0.5);
  uv.size = {mirror_x ? -size.x() : size.x(), mirror_y ? -size.y() : size.y()};
  uv.origin = {uv.size.x() < 0 ? 1.0f : 0.0f, uv.size.y() < 0 ? 1.0f : 0.0f};
  const Vector3f corner(low.x(), high.y(), 0);
  const Vector3f right(high.x() - low.x(), 0, 0), down(0, low.y() - high.y(), 0);
  const std::size_t first = mesh->positions.size();
  AddQuad(mesh, corner, right, down, uv, material);
  if (!swap) return;
  for (std::size_t i = first; i < mesh->uvs.size(); ++i)
    mesh->uvs[i] = mesh->uvs[i].reverse().eval();
}

void AddStripe(TriangleMesh* mesh, const Vector2f& from, const Vector2f& to, float width,
               std::uint16_t material, float tile_m) {
  const Vector2f along = to - from;
  const Vector2f left = Vector2f(-along.y(), along.x()).normalized() * width;
  const Vector2f corner = from + left / 2;
  const UvRect uv{{from.x() * 0.37f, from.y() * 0.61f}, {along.norm() / tile_m, width / tile_m}};
  AddQuad(mesh, {corner.x(), corner.y(), kPaint_m}, {along.x(), along.y(), 0},
          {-left.x(), -left.y(), 0}, uv, material);
}

void AddFrame(TriangleMesh* mesh, const Vector2f& low, const Vector2f& high, float width,
              std::uint16_t material) {
  const Vector2f a = low, b(high.x(), low.y()), c = high, d(low.x(), high.y());
  AddStripe(mesh, a, b, width, material, 1.5f);
  AddStripe(mesh, b, c, width, material, 1.5f);
  AddStripe(mesh, c, d, width, material, 1.5f);
  AddStripe(mesh, d, a, width, material, 1.5f);
}

/// A zebra crossing: bars across the shorter way.
void AddCrossing(TriangleMesh* mesh, const Vector2f& low, const Vector2f& high,
                 std::uint16_t material) {
  constexpr float kBar_m = 0.35f;
  for (float y = low.y() + kBar_m / 2; y < high.y(); y += 2 * kBar_m) {
    AddStripe(mesh, {low.x(), y}, {high.x(), y}, kBar_m, material, 1.5f);
  }
}

/// A raised slab with a kerb.
void AddPavement(TriangleMesh* mesh, const Vector2f& low, const Vector2f& high,
                 std::uint16_t material) {
  constexpr float kKerb_m = 0.12f, kSlab_m = 2.5f;
  const Vector3f size(high.x() - low.x(), high.y() - low.y(), kKerb_m);
  BoxPaint paint = BoxPaint::Tiled(material, size, kSlab_m);
  paint.faces = kNoBottom;
  const Vector2f middle = (low + high) / 2;
  AddBox(mesh, At(middle.x(), middle.y(), kKerb_m / 2), size, paint);
}

}  // namespace

void AddFloor(const Scene& scene, const Palette& palette, std::uint64_t seed,
              WorldBuilder* builder) {
  const Vector2f low = scene.hall.from.cast<float>(), high = scene.hall.to.cast<float>();
  builder->Add("floor", ObjectClass::kFloor, [&](TriangleMesh* mesh) {
    std::uint64_t row = 0;
    for (float y = low.y(); y < high.y(); y += kFloorSheet_m, ++row) {
      std::uint64_t column = 0;
      for (float x = low.x(); x < high.x(); x += kFloorSheet_m, ++column) {
        Dice dice(seed, {200, row, column});
        const std::uint16_t sheet =
            palette.floor[static_cast<std::size_t>(dice.Pick(static_cast<int>(kFloorSheets)))];
        AddSlab(mesh, {x, y}, Vector2f(x + kFloorSheet_m, y + kFloorSheet_m).cwiseMin(high), sheet,
                dice);
      }
    }
  });
}

void AddMarkings(const Scene& scene, const Palette& palette, WorldBuilder* builder) {
  if (scene.markings.empty()) return;
  builder->Add("markings", ObjectClass::kFloor, [&](TriangleMesh* mesh) {
    for (const MarkingSpec& marking : scene.markings) {
      const Vector2f from = marking.from.cast<float>(), to = marking.to.cast<float>();
      const Vector2f low = from.cwiseMin(to), high = from.cwiseMax(to);
      switch (marking.kind) {
        case MarkingSpec::Kind::kLine:
          AddStripe(mesh, from, to, static_cast<float>(marking.width_m), palette.line_paint, 1.5f);
          break;
        case MarkingSpec::Kind::kBox:
          AddStripe(mesh, {low.x(), (low.y() + high.y()) / 2}, {high.x(), (low.y() + high.y()) / 2},
                    high.y() - low.y(), palette.hatch, 1.6f);
          AddFrame(mesh, low, high, static_cast<float>(marking.width_m), palette.line_paint);
          break;
        case MarkingSpec::Kind::kCrossing:
          AddCrossing(mesh, low, high, palette.line_paint);
          break;
        case MarkingSpec::Kind::kPavement:
          AddPavement(mesh, low, high, palette.pavement);
          break;
      }
    }
  });
}

}  // namespace aisle::sim
