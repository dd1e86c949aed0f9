#include "simulator/scene/mezzanine.h"
#include "simulator/world/goods.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kDeck_m = 0.06f, kBeam_m = 0.22f;
constexpr float kRail_m = 1.1f;  ///< above the deck
// A pallet of 1.2 m by 0.8 m that is turned by up to 0.1 rad needs 1.28 m by 0.92 m.
constexpr float kPalletPitchX_m = 1.35f, kPalletPitchY_m = 1.0f;

/// Places of pallets from one end to the other, evenly: about `pitch` apart, never nearer than
/// `least`; where that leaves no room for two, one in the middle.
std::vector<float> Places(float from, float to, float pitch, float least) {
  if (to - from < least) return {(from + to) / 2};
  const int most = static_cast<int>(std::floor((to - from) / least));
  return Evenly(from, to, std::min(most, static_cast<int>(std::ceil((to - from) / pitch))));
}

void AddFrame(TriangleMesh* mesh, const std::vector<float>& xs, const std::vector<float>& ys,
              float deck, const Palette& palette) {
  const float top = deck - kDeck_m, middle = top - kBeam_m / 2;
  for (const float x : xs) {
    AddBar(mesh, {x, ys.front(), middle}, {x, ys.back(), middle}, kBeam_m, palette.upright);
    for (const float y : ys) {
      AddBar(mesh, {x, y, 0}, {x, y, top}, MezzanineFeet::kColumn_m, palette.upright);
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
void AddStair(TriangleMesh* mesh, const MezzanineFeet& feet, float deck, const Palette& palette) {
  constexpr float kTread_m = MezzanineFeet::kTread_m;
  const Vector2f top = feet.stair_top;
  const float rise = deck / static_cast<float>(feet.stair_steps);
  for (int i = 1; i < feet.stair_steps; ++i) {
    const float k = static_cast<float>(i);
    const Vector3f tread(2 * MezzanineFeet::kStairHalfWidth_m, kTread_m, 0.04f);
    AddBox(mesh, At(top.x(), top.y() - k * kTread_m, deck - k * rise), tread,
           BoxPaint::Tiled(palette.steel, tread, 1));
  }
  const float run = feet.stair_run_m();
  for (const float side : {-MezzanineFeet::kStairHalfWidth_m, MezzanineFeet::kStairHalfWidth_m}) {
    const float x = top.x() + side;
    AddBar(mesh, {x, top.y(), deck - 0.06f}, {x, top.y() - run, 0.02f}, 0.07f, palette.upright);
    AddBar(mesh, {x, top.y(), deck + 0.95f}, {x, top.y() - run, 0.98f}, 0.045f, palette.stripes);
    AddBar(mesh, {x, top.y() - run, 0}, {x, top.y() - run, 0.98f}, 0.05f, palette.stripes);
  }
}

}  // namespace

void AddMezzanines(const Scene& scene, const Palette& palette, std::uint64_t seed,
                   WorldBuilder* builder) {
  for (std::size_t i = 0; i < scene.mezzanines.size(); ++i) {
    const MezzanineSpec& spec = scene.mezzanines[i];
    const Vector2f low = spec.from.cast<float>(), high = spec.to.cast<float>();
    const auto deck = static_cast<float>(spec.height_m);
    builder->Add(fmt::format("mezzanine_{}", i), ObjectClass::kFurniture, [&](TriangleMesh* mesh) {
      const MezzanineFeet feet = FeetOf(spec);
      const Vector3f slab(high.x() - low.x(), high.y() - low.y(), kDeck_m);
      AddBox(mesh, At((low.x() + high.x()) / 2, (low.y() + high.y()) / 2, deck - kDeck_m / 2), slab,
             BoxPaint::Tiled(palette.steel, slab, 1.2f));
      AddFrame(mesh, feet.xs, feet.ys, deck, palette);
      const Vector2f corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
      for (int k = 0; k < 4; ++k) AddRailing(mesh, corners[k], corners[(k + 1) % 4], deck, palette);
      AddStair(mesh, feet, deck, palette);
    });
    builder->Add(
        fmt::format("mezzanine_{}_goods", i), ObjectClass::kGoods, [&](TriangleMesh* mesh) {
          std::uint64_t place = 0;
          for (const float x : Places(low.x() + 1, high.x() - 1, 1.7f, kPalletPitchX_m)) {
            for (const float y : Places(low.y() + 1, high.y() - 1, 1.6f, kPalletPitchY_m)) {
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
