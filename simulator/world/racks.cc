#include <cmath>
#include <numbers>

#include "simulator/world/goods.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

constexpr float kPost_m = 0.1f;
constexpr float kBeamTall_m = 0.12f;
constexpr float kGuardTall_m = 0.4f;

/// A rack in its own frame: x along the row, y across, origin at the start of the centre line.
class RackBuilder {
 public:
  RackBuilder(const RackSpec& rack, const Palette& palette, TriangleMesh* mesh)
      : rack_(rack),
        palette_(palette),
        mesh_(mesh),
        pose_(At(static_cast<float>(rack.from.x()), static_cast<float>(rack.from.y()), 0,
                 static_cast<float>(rack.heading_rad))),
        post_(palette.posts[static_cast<std::size_t>(rack.paint)]),
        half_depth_(static_cast<float>(rack.depth_m) / 2),
        bay_(static_cast<float>(rack.bay_m)),
        level_(static_cast<float>(rack.level_m)) {}

  float height() const { return level_ * static_cast<float>(rack_.levels) + 0.6f; }

  void AddFrames() {
    for (int i = 0; i <= rack_.bays; ++i) {
      const float x = bay_ * static_cast<float>(i);
      for (const float y : {-half_depth_ + kPost_m / 2, half_depth_ - kPost_m / 2}) {
        const Vector3f size(kPost_m, kPost_m * 0.8f, height());
        BoxPaint paint = BoxPaint::Whole(post_, {{0, 0}, {1, height() / 0.4f}});
        AddBox(mesh_, pose_ * At(x, y, height() / 2), size, paint);
        AddGuard(x, y);
      }
      for (float z = 0.3f; z + 0.7f < height(); z += 1.4f) {  // bracing
        const float y = half_depth_ - kPost_m;
        AddBar(mesh_, pose_ * Vector3f(x, -y, z), pose_ * Vector3f(x, y, z + 0.7f), 0.035f, post_);
        AddBar(mesh_, pose_ * Vector3f(x, y, z + 0.7f),
               pose_ * Vector3f(x, -y, std::min(z + 1.4f, height())), 0.035f, post_);
      }
    }
  }

  void AddBeams() {
    for (int level = 1; level <= rack_.levels; ++level) {
      for (int bay = 0; bay < rack_.bays; ++bay) {
        const float x = bay_ * (static_cast<float>(bay) + 0.5f);
        const float z = Shelf(level) - kBeamTall_m / 2;
        for (const float y : {-half_depth_ + 0.03f, half_depth_ - 0.03f}) {
          const Vector3f size(bay_ - kPost_m, 0.05f, kBeamTall_m);
          BoxPaint paint = BoxPaint::Whole(
              palette_.beam,
              {{0.37f * static_cast<float>(bay + 3 * level), 0.1f}, {bay_ / 1.35f, 0.36f}});
          AddBox(mesh_, pose_ * At(x, y, z), size, paint);
        }
        AddBayLabels(bay, level, x, z);
        for (int i = 0; i < 4; ++i) {  // cross supports
          const float at = x + bay_ * (static_cast<float>(i) - 1.5f) / 4;
          AddBar(mesh_, pose_ * Vector3f(at, -half_depth_, z + 0.03f),
                 pose_ * Vector3f(at, half_depth_, z + 0.03f), 0.04f, palette_.steel);
        }
      }
    }
  }

  /// Plates with the row's name at both ends, below the frame's top; too low a rack has none.
  void AddEndSigns(std::size_t row) {
    constexpr float kSide_m = 0.7f, kBelowTop_m = 0.05f;
    const Vector3f size(0.02f, kSide_m, kSide_m);
    const float middle = std::min(2.2f, height() - kBelowTop_m - kSide_m / 2);
    if (middle < kSide_m) return;
    for (const float x : {-kPost_m, bay_ * static_cast<float>(rack_.bays) + kPost_m}) {
      AddBox(mesh_, pose_ * At(x, 0, middle), size,
             BoxPaint::Whole(palette_.sign, palette_.aisle_signs[row % kAisleSigns]));
    }
  }

  void AddStored(std::uint64_t seed, std::uint64_t row) {
    if (rack_.goods == GoodsKind::kNothing) return;  // no pallets either
    const int places = std::max(1, static_cast<int>((bay_ - kPost_m) / (kPalletWidth_m + 0.05f)));
    for (int level = 0; level <= rack_.levels; ++level) {
      for (int bay = 0; bay < rack_.bays; ++bay) {
        for (int place = 0; place < places; ++place) {
          Dice dice(seed, {300, row, static_cast<std::uint64_t>(level),
                           static_cast<std::uint64_t>(bay), static_cast<std::uint64_t>(place)});
          if (!dice.Chance(rack_.fill)) continue;
          const float pitch = (bay_ - kPost_m) / static_cast<float>(places);
          const float x = bay_ * static_cast<float>(bay) + kPost_m / 2 +
                          pitch * (static_cast<float>(place) + 0.5f);
          AddPlace(x, level, pitch, std::move(dice));
        }
      }
    }
  }

 private:
  float Shelf(int level) const { return level_ * static_cast<float>(level); }

  void AddGuard(float x, float y) {
    const float side = y < 0 ? -0.09f : 0.09f;
    const Vector3f size(kPost_m + 0.08f, 0.05f, kGuardTall_m);
    AddBox(mesh_, pose_ * At(x, y + side, kGuardTall_m / 2), size,
           BoxPaint::Tiled(palette_.stripes, size, 0.4f));
  }

  /// A plate with the place's name on the beams of both sides, and two barcodes.
  void AddBayLabels(int bay, int level, float x, float z) {
    const std::size_t picture = static_cast<std::size_t>(bay * 3 + level * 5) % kBayLabels;
    const float out = half_depth_ - 0.03f + 0.028f;
    for (const float side : {-1.0f, 1.0f}) {
      const Vector3f right = pose_.linear() * Vector3f(-side * 0.2f, 0, 0);
      const Vector3f corner = pose_ * Vector3f(x + side * 0.1f, side * out, z + 0.05f);
      AddQuad(mesh_, corner, right, {0, 0, -0.1f}, palette_.bay_labels[picture], palette_.sign);
    }
  }

  void AddPlace(float x, int level, float pitch, Dice dice) {
    const bool tidy = rack_.goods == GoodsKind::kIdentical;
    const float turn =
        std::numbers::pi_v<float> / 2 + (tidy ? 0.0f : static_cast<float>(0.03 * dice.Signed()));
    const float y = tidy ? 0 : static_cast<float>(0.04 * dice.Signed());
    const Eigen::Isometry3f at = pose_ * At(x, y, Shelf(level), turn);
    const float room = level_ - kPalletHeight_m - kBeamTall_m - 0.15f;
    const float height = room * (tidy ? 0.8f : static_cast<float>(dice.Between(0.45, 1)));
    const bool deep = rack_.depth_m > 0.9 && pitch > kPalletWidth_m && room > 0.3f;
    if (deep) {
      AddLoadedPallet(mesh_, palette_, at, height, rack_.goods, dice);
    } else {  // shelving: goods stand on the boards
      AddGoods(mesh_, palette_, at, {static_cast<float>(rack_.depth_m) * 0.9f, pitch * 0.92f},
               std::max(0.15f, level_ - 0.25f), rack_.goods, dice);
    }
  }

  const RackSpec& rack_;
  const Palette& palette_;
  TriangleMesh* mesh_;
  Eigen::Isometry3f pose_;
  std::uint16_t post_;
  float half_depth_, bay_, level_;
};

}  // namespace

void AddRacks(const Scene& scene, const Palette& palette, std::uint64_t seed,
              WorldBuilder* builder) {
  for (std::size_t i = 0; i < scene.racks.size(); ++i) {
    const RackSpec& rack = scene.racks[i];
    builder->Add(fmt::format("rack_{}", i), ObjectClass::kRack, [&](TriangleMesh* mesh) {
      RackBuilder builder(rack, palette, mesh);
      builder.AddFrames();
      builder.AddBeams();
      builder.AddEndSigns(i);
    });
    builder->Add(fmt::format("goods_{}", i), ObjectClass::kGoods,
                 [&](TriangleMesh* mesh) { RackBuilder(rack, palette, mesh).AddStored(seed, i); });
  }
}

void AddStacks(const Scene& scene, const Palette& palette, std::uint64_t seed,
               WorldBuilder* builder) {
  for (std::size_t i = 0; i < scene.stacks.size(); ++i) {
    const StackSpec& stack = scene.stacks[i];
    builder->Add(fmt::format("stack_{}", i), ObjectClass::kGoods, [&](TriangleMesh* mesh) {
      AddLoadedPallet(mesh, palette,
                      At(static_cast<float>(stack.at.x()), static_cast<float>(stack.at.y()), 0,
                         static_cast<float>(stack.heading_rad)),
                      static_cast<float>(stack.height_m), stack.goods, Dice(seed, {310, i}));
    });
  }
}

}  // namespace aisle::sim
