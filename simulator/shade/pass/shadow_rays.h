#pragma once

#include <array>
#include <span>
#include <vector>

#include "simulator/shade/pass/pattern_filter.h"
#include "simulator/shade/pass/shadow_plan.h"
#include "simulator/shade/pass/static_pixels.h"

namespace aisle::sim {

/// Eight points whose shadows are asked for.
struct ShadowedPoints8 {
  StaticPoints8 points;
  F8 irradiance;  ///< of the static world
  int row = 0;    ///< of the pattern of samples, which begins anew after ShadowRays::kRows
};

/// One shadow ray a point, light and mover, and a few short rays for indirect light, in a 4 × 4
/// pattern of directions.
class ShadowRays {
 public:
  static constexpr std::size_t kMostPackets = 16;  ///< of points that are asked about together
  static constexpr int kRows = 4;  ///< of the pattern: a lane has one sample in each

  /// `shading` must outlive it.
  explicit ShadowRays(const ShadingView& shading) : shading_(shading) {}

  /// Sets `lost`, by packet, to the irradiance that movers keep away, unfiltered.
  void FindLost(std::span<const ShadowedPoints8> packets, const ShadowPlan& plan,
                std::span<F8> lost) const;

 private:
  static constexpr std::size_t kAmbientRays = 2;  // a point

  /// Sample positions of the 4 × 4 pattern for eight pixels of a row: neighbours differ much, and
  /// each 4 × 4 block has all sixteen.
  struct Pattern {
    struct Row {
      F8 a, b;                                       ///< on a light, in [-1, 1]
      std::array<F8x3, kAmbientRays> local_ambient;  ///< cosine-distributed, z = normal
    };
    std::array<Row, kRows> rows;

    Pattern();
    const Row& At(int row) const { return rows[static_cast<std::size_t>(row % kRows)]; }
  };

  void AddDirect(const ShadowBlocker& blocker, std::span<const ShadowedPoints8> packets,
                 std::span<F8> lost) const;
  void AddIndirect(GeometryMask movers, std::span<const ShadowedPoints8> packets,
                   std::span<F8> lost) const;
  F8 IndirectAt(const ShadowedPoints8& packet, I8 wanted) const;

  const ShadingView& shading_;
  Pattern pattern_;
};

}  // namespace aisle::sim
