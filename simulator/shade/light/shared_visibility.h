#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulator/shade/light/point_groups.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// The corners of a leaf need no shadow rays each: the points of a loose thing (LooseThings) that
/// face alike are as visible to the luminaires as one of them, and each has of its light what it
/// would have of unshadowed light.
struct SharedVisibility {
  std::vector<std::uint32_t> traced;    ///< the points that need rays: the fixed ones, then others
  std::size_t fixed = 0;                ///< how many of those are fixed
  std::vector<std::uint32_t> of_point;  ///< by point: its place among the traced
  std::vector<float> share;             ///< by point: of that one's light, what it has; 0 to 1

  /// The light of every point, from that of the traced ones.
  std::vector<float> Spread(std::span<const float> traced_light) const;
};

/// By point `things`, as of LooseThings, and `places`, on the posed mesh.
SharedVisibility ShareVisibility(std::span<const std::uint32_t> things,
                                 std::span<const SurfacePoint> places,
                                 std::span<const AreaLight> lights,
                                 std::span<const float> light_scale);

}  // namespace aisle::sim
