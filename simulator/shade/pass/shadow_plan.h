#pragma once

#include <span>
#include <vector>

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/pass/shading_view.h"
#include "simulator/trace/tile_grid.h"

namespace aisle::sim {

/// One light and the movers that may stand between it and a tile.
struct ShadowBlocker {
  std::size_t light;
  GeometryMask movers;
  float most;            ///< irradiance that it can give any point of the tile
  std::size_t row_step;  ///< traced in every row_step-th row of the pattern, and counted as often
};

/// What can darken a tile.
struct ShadowPlan {
  std::vector<ShadowBlocker> blockers;
  GeometryMask near = 0;  ///< movers that may darken indirect light
  bool empty() const { return blockers.empty() && near == 0; }
};

inline constexpr float kAmbientReach = 1.2f;  ///< m: how far a mover darkens indirect light

/// Finds out which lights and movers can matter for what tiles of a picture show of the static
/// world.
class ShadowPlanner {
 public:
  /// Both must outlive it; `irradiance`, of the static world in HitImage rows, tells which lights
  /// are too weak to matter.
  ShadowPlanner(const ShadingView& shading, std::span<const float> irradiance);

  /// `open`: the lanes of the tile's packets, in reading order, that are to be traced. Which lights
  /// are too weak is a question of the whole tile.
  ShadowPlan Plan(const Tile& tile, std::span<const I8> open) const;

 private:
  /// Eight lights; those beyond the last one are off.
  struct Lights8 {
    F8x3 center, half_size;
    I8 is_on;
  };

  /// By light: the movers that may stand between it and a box.
  std::vector<GeometryMask> MoversBefore(const Eigen::AlignedBox3f& box) const;

  const ShadingView& shading_;
  std::span<const float> irradiance_;
  std::vector<Lights8> lights_;
};

}  // namespace aisle::sim
