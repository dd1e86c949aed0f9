#pragma once

#include <Eigen/Geometry>

#include "simulator/shade/lanes/wide.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

/// Lanes whose segment from + t·to, t in [0, 1], meets the box.
I8 MeetBox(const Eigen::AlignedBox3f& box, const F8x3& from, const F8x3& to);

/// The box, wider by that much on each side.
inline Eigen::AlignedBox3f Grown(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& by) {
  return {box.min() - by, box.max() + by};
}

/// Whether a mover keeps light away: clear panes do not.
inline bool CastsShadow(const Instant& instant, std::size_t mover) {
  return instant.snapshot().movers[mover].casts_shadow;
}

/// Movers that may stand between any point of a box and any point of a rectangle: the segment
/// between their middles, thickened by whichever is larger, must meet the mover's box.
GeometryMask MoversBetween(const Instant& instant, const Eigen::AlignedBox3f& box,
                           const Eigen::Vector3f& center, const Eigen::Vector3f& half_u,
                           const Eigen::Vector3f& half_v);

/// Lanes (as bits) of whose segment from + t·to, t in [0, t_far], one of the movers blocks some;
/// each mover is asked for those lanes alone that meet its box.
unsigned BlockedByMovers(const Instant& instant, GeometryMask movers, const F8x3& from,
                         const F8x3& to, F8 t_far, I8 valid);

}  // namespace aisle::sim
