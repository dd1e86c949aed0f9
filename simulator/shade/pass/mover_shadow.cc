#include "simulator/shade/pass/mover_shadow.h"

#include <array>
#include <optional>

#include "simulator/shade/pass/other_camera.h"
#include "simulator/shade/pass/pattern_filter.h"
#include "simulator/shade/pass/shadow_rays.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 16, kTileHeight = 8;
constexpr std::size_t kTilePackets = kTileWidth * kTileHeight / kLanes;
static_assert(kTilePackets <= ShadowRays::kMostPackets);

/// Takes over what another camera found for the points that both see.
class SeenBefore {
 public:
  SeenBefore(const ShadingView& shading, const SeenShadows* seen)
      : shading_(shading), pixels_(shading) {
    if (!seen) return;
    camera_.emplace(seen->view, seen->image);
    raw_ = seen->raw;
  }

  /// The lanes of eight pixels that are left to trace; `lost` is set where the others lost light.
  I8 TakeOver(int x, int y, std::vector<float>* raw, bool* lost) const {
    const I8 active = pixels_.Lanes(x, y);
    if (!camera_ || !Any(active)) return active;
    const std::size_t i = shading_.image.Index(x, y);
    I8 pixels{};
    const I8 found = camera_->Find(pixels_.PositionsOf(x, y, active),
                                   LoadI(&shading_.image.primitive[i]), active, &pixels);
    if (!Any(found)) return active;
    const F8 kept = Select(found, Gather(raw_.data(), pixels), Wide(1));
    *lost |= Any(kept < 1);
    Store(kept, &(*raw)[i]);
    return active & ~found;
  }

 private:
  const ShadingView& shading_;
  StaticPixels pixels_;
  std::optional<OtherCamera> camera_;
  std::span<const float> raw_;
};

/// Averages the pattern in the tiles that lost light and those around them; `kept` is 1 before.
void Filter(const ShadingView& shading, const TileGrid& grid, std::span<const std::uint8_t> lost,
            std::span<const float> raw, std::vector<float>* kept) {
  const PatternFilter filter(shading.image, shading.tables.statics(), raw);
  const StaticPixels pixels(shading);
  const int columns = grid.columns(), rows = grid.rows();
  const auto is_lost = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < columns && row < rows &&
           lost[static_cast<std::size_t>(row * columns + column)];
  };
  grid.ForEach([&](std::size_t i, const Tile& tile) {
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    bool near = false;
    for (int d = 0; d < 9; ++d) near |= is_lost(column + d % 3 - 1, row + d / 3 - 1);
    if (!near) return;
    ForRows(tile, kLanes, [&](int x, int y) {
      const I8 is_static = pixels.Lanes(x, y);
      if (Any(is_static) && !filter.OnesAround(x, y)) filter.Packet(x, y, is_static, kept);
    });
  });
}

/// Writes the unfiltered share of light that is left at the open lanes of a tile's packets; whether
/// any lost light.
bool TraceTile(const ShadingView& shading, const ShadowRays& rays, const ShadowPlan& plan,
               std::span<const float> irradiance, const Tile& tile, std::span<const I8> open,
               std::vector<float>* raw) {
  const StaticPixels pixels(shading);
  std::array<ShadowedPoints8, kTilePackets> packets;
  std::array<std::size_t, kTilePackets> at;
  std::size_t count = 0, packet = 0;
  ForRows(tile, kLanes, [&](int x, int y) {
    const I8 lanes = open[packet++];
    if (!Any(lanes)) return;
    at[count] = shading.image.Index(x, y);
    packets[count] = {pixels.Locate(x, y, lanes), LoadF(&irradiance[at[count]]), y};
    ++count;
  });
  std::array<F8, kTilePackets> lost;
  rays.FindLost(std::span(packets).first(count), plan, lost);
  bool any_lost = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (!Any(lost[i] > 0)) continue;
    any_lost = true;
    const F8 kept = 1 - lost[i] / Max(packets[i].irradiance, Wide(1e-9f));
    float* const to = &(*raw)[at[i]];
    Store(Select(packets[i].points.active, kept, LoadF(to)), to);
  }
  return any_lost;
}

}  // namespace

void TraceMoverShadows(const ShadingView& shading, std::span<const float> irradiance,
                       const SeenShadows* seen, std::vector<float>* raw, std::vector<float>* kept) {
  kept->assign(irradiance.size(), 1);
  raw->assign(irradiance.size(), 1);
  if (shading.instant.snapshot().movers.empty() || shading.tables.statics().empty()) return;
  const SeenBefore before(shading, seen);
  const ShadowPlanner planner(shading);
  const ShadowRays rays(shading);
  const TileGrid grid{shading.image.width, shading.image.height, kTileWidth, kTileHeight};
  std::vector<std::uint8_t> lost(grid.size());
  grid.ForEach([&](std::size_t i, const Tile& tile) {
    std::array<I8, kTilePackets> open;
    std::size_t packet = 0;
    bool any_open = false, any_lost = false;
    ForRows(tile, kLanes, [&](int x, int y) {
      open[packet] = before.TakeOver(x, y, raw, &any_lost);
      any_open |= Any(open[packet++]);
    });
    const ShadowPlan plan = any_open ? planner.Plan(tile, open, irradiance) : ShadowPlan{};
    if (!plan.empty()) any_lost |= TraceTile(shading, rays, plan, irradiance, tile, open, raw);
    lost[i] = any_lost;
  });
  Filter(shading, grid, lost, *raw, kept);
}

}  // namespace aisle::sim
