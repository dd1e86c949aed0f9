#pragma once

#include <span>
#include <vector>

#include "simulator/shade/lanes/frame8.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

/// Eight places on glossy surfaces, and the way to the camera in their frames.
struct LobePoints8 {
  F8x3 position;  ///< lifted off the surface
  Frame8 basis;
  F8x3 out;  ///< unit, local
  F8 f0, roughness;
};

/// Where a place looks for a lamp: which one, and where on it. All in [0, 1).
struct LampChoice8 {
  F8 which, a, b;
};

/// What broad lobes mirror of the luminaires. A mirrored ray finds a lamp in a broad lobe too
/// seldom; here each place aims one shadow ray at a point of a lamp (next-event estimation), chosen
/// by what the lamps' middles give a lobe widened by the lamps' size.
class LobeLamps {
 public:
  /// The lights as bright as they are at the instant, which must outlive it.
  LobeLamps(const Instant& instant, std::span<const AreaLight> lights);

  /// Radiance towards the camera, for the valid lanes.
  F8 Mirrored(const LobePoints8& points, const LampChoice8& choice, I8 valid) const;

 private:
  struct Lamp {
    Eigen::Vector3f center, half_u, half_v, normal;
    float power, extent;
  };
  F8 Importance(const Lamp& lamp, const LobePoints8& points) const;

  const Instant& instant_;
  GeometryMask blockers_;
  std::vector<Lamp> lamps_;
};

}  // namespace aisle::sim
