#include "simulator/world/goods.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kDeck_m = 0.06f, kBeam_m = 0.22f, kColumn_m = 0.16f;
constexpr float kBay_m = 3.2f;   ///< at most so far from column to column
constexpr float kRail_m = 1.1f;  ///< above the deck

/// Points from one end to the other, evenly, at most `pitch` apart.
std::vector<float> Divide(float from, float to, float pitch) {
  const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / pitch)));
  std::vector<float> points;
  for (int i = 0; i <= parts; ++i) {
    points.push_back(from + (to - from) * static_cast<float>(i) / static_cast<float>(parts));
  }
  return points;
}

void AddFrame(TriangleMesh* mesh, const std::vector<float>& xs, const std::vector<float>& ys,
              float deck, const Palette& palette) {
  const float top = deck - kDeck_m, middle = top - kBeam_m / 2;
  for (const float x : xs) {
    AddBar(mesh, {x, ys.front(), middle}, {x, ys.back(), middle}, kBeam_m, palette.upright);
    for (const float y : ys) {
      AddBar(mesh, {x, y, 0}, {x, y, top}, kColumn_m, palette.upright);
      const Vector3f foot(0.32f, 0.32f, 0.03f);
      AddBox(mesh, At(x, y, 0.015f), foot, BoxPaint::Whole(palette.steel));
    }
  }
  for (const float y : Divide(ys.front(), ys.back(), 0.8f)) {
    AddBar(mesh, {xs.front(), y, middle}, {xs.back(), y, middle}, 0.12f, palette.steel);
  }
}

void AddRailing(TriangleMesh* mesh, const Vector2f& from, const Vector2f& to, float deck,
                const Palette& palette) {
  for (const float share : Divide(0, 1, 1.2f / (to - from).norm())) {
    const Vector2f at = from + share * (to - from);
    AddBar(mesh, {at.x(), at.y(), deck}, {at.x(), at.y(), deck + kRail_m}, 0.05f, palette.stripes);
  }
  for (const float height : {0.08f, 0.55f, kRail_m}) {
    AddBar(mesh, {from.x(), from.y(), deck + height}, {to.x(), to.y(), deck + height}, 0.05f,
           palette.stripes);
  }
}

/// A stair along y, down from the middle of the front edge.
void AddStair(TriangleMesh* mesh, const Vector2f& top, float deck, const Palette& palette) {
  constexpr float kWidth_m = 0.9f, kTread_m = 0.26f, kRise_m = 0.19f;
  const int steps = static_cast<int>(std::floor(deck / kRise_m));
  const float rise = deck / static_cast<float>(steps);
  for (int i = 1; i < steps; ++i) {
    const float k = static_cast<float>(i);
    const Vector3f tread(kWidth_m, kTread_m, 0.04f);
    AddBox(mesh, At(top.x(), top.y() - k * kTread_m, deck - k * rise), tread,
           BoxPaint::Tiled(palette.steel, tread, 1));
  }
  const float run = static_cast<float>(steps) * kTread_m;
  for (const float side : {-kWidth_m / 2, kWidth_m / 2}) {
    const float x = top.x() + side;
    AddBar(mesh, {x, top.y(), deck - 0.06f}, {x, top.y() - run, 0.02f}, 0.07f, palette.upright);
    AddBar(mesh, {x, top.y(), deck + 0.95f}, {x, top.y() - run, 0.98f}, 0.045f, palette.stripes);
    AddBar(mesh, {x, top.y() - run, 0}, {x, top.y() - run, 0.98f}, 0.05f, palette.stripes);
  }
}

}  // namespace

void AddMezzanines(const Scene& scene, const Palette& palette, std::uint64_t seed, Site* site) {
  for (std::size_t i = 0; i < scene.mezzanines.size(); ++i) {
    const MezzanineSpec& spec = scene.mezzanines[i];
    const Vector2f low = spec.from.cast<float>(), high = spec.to.cast<float>();
    const auto deck = static_cast<float>(spec.height_m);
    site->Add(fmt::format("mezzanine_{}", i), ObjectClass::kFurniture, [&](TriangleMesh* mesh) {
      const std::vector<float> xs = Divide(low.x() + 0.1f, high.x() - 0.1f, kBay_m);
      const std::vector<float> ys = Divide(low.y() + 0.1f, high.y() - 0.1f, kBay_m);
      const Vector3f slab(high.x() - low.x(), high.y() - low.y(), kDeck_m);
      AddBox(mesh, At((low.x() + high.x()) / 2, (low.y() + high.y()) / 2, deck - kDeck_m / 2), slab,
             BoxPaint::Tiled(palette.steel, slab, 1.2f));
      AddFrame(mesh, xs, ys, deck, palette);
      const Vector2f corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
      for (int k = 0; k < 4; ++k) AddRailing(mesh, corners[k], corners[(k + 1) % 4], deck, palette);
      AddStair(mesh, {high.x() - 1.0f, low.y()}, deck, palette);
    });
    site->Add(fmt::format("mezzanine_{}_goods", i), ObjectClass::kGoods, [&](TriangleMesh* mesh) {
      std::uint64_t place = 0;
      for (const float x : Divide(low.x() + 1, high.x() - 1, 1.7f)) {
        for (const float y : Divide(low.y() + 1, high.y() - 1, 1.6f)) {
          Dice dice(seed, {330, i, place++});
          if (!dice.Chance(0.6)) continue;
          const auto turn = static_cast<float>(0.1 * dice.Signed());
          const auto tall = static_cast<float>(dice.Between(0.5, 1.3));
          AddLoadedPallet(mesh, palette, At(x, y, deck, turn), tall, GoodsKind::kMixed, dice);
        }
      }
    });
  }
}

}  // namespace aisle::sim
