#pragma once

#include <span>
#include <vector>

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/pass/shading_view.h"
#include "simulator/trace/tile_grid.h"

namespace aisle::sim {

/// One light and the movers that may stand between it and some points.
struct ShadowBlocker {
  std::size_t light;
  GeometryMask movers;
  float most;                ///< irradiance that it can give any of the points
  std::size_t row_step = 1;  ///< traced in every row_step-th row of the pattern, counted as often
};

/// What can darken some points of the static world.
struct ShadowPlan {
  std::vector<ShadowBlocker> blockers;
  GeometryMask near = 0;  ///< movers that may darken indirect light
  bool empty() const { return blockers.empty() && near == 0; }
};

inline constexpr float kAmbientReach = 1.2f;  ///< m: how far a mover darkens indirect light

/// Finds out which lights and movers can matter for what a picture shows of the static world.
class ShadowPlanner {
 public:
  /// Must outlive it.
  explicit ShadowPlanner(const ShadingView& shading);

  /// `open`: the lanes of the tile's packets, in reading order, that are to be traced. Which lights
  /// are too weak is a question of the whole tile; `irradiance`, of the static world in HitImage
  /// rows, tells. What the plan finds is to be averaged over the rows of the pattern.
  ShadowPlan Plan(const Tile& tile, std::span<const I8> open,
                  std::span<const float> irradiance) const;
  /// For points anywhere in a box which have so much light in the mean: each row is complete.
  ShadowPlan Plan(const Eigen::AlignedBox3f& box, float mean_irradiance) const;

 private:
  /// Eight lights; those beyond the last one are off.
  struct Lights8 {
    F8x3 center, half_size;
    I8 is_on;
  };

  /// By light: the movers that may stand between it and a box.
  std::vector<GeometryMask> MoversBefore(const Eigen::AlignedBox3f& box) const;
  /// All that may darken points of the box, be it ever so little.
  ShadowPlan PlanAll(const Eigen::AlignedBox3f& box) const;
  /// Leaves of the blockers the movers that may stand between the lights and the box.
  void Narrow(const Eigen::AlignedBox3f& box, std::vector<ShadowBlocker>* blockers) const;

  const ShadingView& shading_;
  std::vector<Lights8> lights_;
};

}  // namespace aisle::sim
