#pragma once

#include <span>
#include <vector>

#include "simulator/shade/light/emitter_visibility.h"

namespace aisle::sim {

/// How an emitter is asked for: by so many rays a place, against these movers.
struct EmitterRays {
  int rays = 0;  ///< 0: no mover stands between, or it is too weak
  GeometryMask movers = 0;
  bool unasked = false;  ///< too weak: taken to be seen as well as the others are in the mean
};

/// Rays for each emitter by its share of the light, and the movers that may stand between it and
/// the box, out of `movers`.
std::vector<EmitterRays> PlanEmitterRays(const Instant& instant, const Emitters& emitters,
                                         const Eigen::AlignedBox3f& box, GeometryMask movers);

/// What movers leave of the emitters.
EmitterVisibility TraceMoverShadowsOn(const Instant& instant, const Emitters& emitters,
                                      std::span<const EmitterRays> plan,
                                      std::span<const ShadowedPlace> places);

}  // namespace aisle::sim
