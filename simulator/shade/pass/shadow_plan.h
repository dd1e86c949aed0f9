#pragma once

#include <span>
#include <vector>

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

/// Which lights and movers can matter for what a tile shows of the static world, whose irradiance,
/// in HitImage rows, tells which lights are too weak for that.
ShadowPlan PlanShadows(const ShadingView& shading, std::span<const float> irradiance,
                       const Tile& tile);

}  // namespace aisle::sim
