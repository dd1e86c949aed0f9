#pragma once

#include <array>
#include <span>
#include <vector>

#include "simulator/shade/pass/pattern_filter.h"
#include "simulator/shade/pass/shadow_plan.h"
#include "simulator/shade/pass/static_pixels.h"

namespace aisle::sim {

/// One shadow ray a pixel, light and mover, and a few short rays for indirect light, in a 4 × 4
/// pattern of directions.
class ShadowRays {
 public:
  /// Both must outlive it; `irradiance` is the static world's, in HitImage rows.
  ShadowRays(const ShadingView& shading, std::span<const float> irradiance)
      : shading_(shading), irradiance_(irradiance), pixels_(shading) {}

  /// Writes the unfiltered share of light that is left at eight pixels; whether any lost light.
  bool Trace(int x, int y, I8 lanes, const ShadowPlan& plan, std::vector<float>* raw) const;

 private:
  static constexpr int kAmbientRays = 2;  // a pixel

  /// Sample positions of the 4 × 4 pattern for eight pixels of a row: neighbours differ much, and
  /// each 4 × 4 block has all sixteen.
  struct Pattern {
    struct Row {
      F8 a, b;                                       ///< on a light, in [-1, 1]
      std::array<F8x3, kAmbientRays> local_ambient;  ///< cosine-distributed, z = normal
    };
    std::array<Row, 4> rows;

    Pattern();
  };

  I8 MayMeet(GeometryMask movers, const F8x3& from, const F8x3& to) const;
  I8 OnLuminaires(std::size_t pixel, I8 lanes) const;
  F8 LostDirect(const ShadowBlocker& blocker, const Pixels8& pixels, const Pattern::Row& at) const;
  F8 LostIndirect(GeometryMask movers, const Pixels8& pixels, const Pattern::Row& at, int x,
                  int y) const;

  const ShadingView& shading_;
  std::span<const float> irradiance_;
  StaticPixels pixels_;
  Pattern pattern_;
};

}  // namespace aisle::sim
