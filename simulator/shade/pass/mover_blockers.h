#pragma once

#include <Eigen/Geometry>
#include <span>

#include "simulator/shade/lanes/wide.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

/// Lanes whose segment from + t·to, t in [0, far], meets the lane's box from `low` to `high`.
inline I8 MeetBoxes(const F8x3& low, const F8x3& high, const F8x3& from, const F8x3& to,
                    F8 far = Wide(1)) {
  F8 near = Wide(0);
  const auto slab = [&](F8 lo, F8 hi, F8 start, F8 along) {
    const F8 safe = Select(Abs(along) < 1e-9f, Wide(1e-9f), along);
    const F8 a = (lo - start) / safe, b = (hi - start) / safe;
    near = Max(near, Min(a, b));
    far = Min(far, Max(a, b));
  };
  slab(low.x, high.x, from.x, to.x);
  slab(low.y, high.y, from.y, to.y);
  slab(low.z, high.z, from.z, to.z);
  return near <= far;
}
/// The same where all lanes have one box.
inline I8 MeetBox(const Eigen::AlignedBox3f& box, const F8x3& from, const F8x3& to,
                  F8 far = Wide(1)) {
  return MeetBoxes({Wide(box.min().x()), Wide(box.min().y()), Wide(box.min().z())},
                   {Wide(box.max().x()), Wide(box.max().y()), Wide(box.max().z())}, from, to, far);
}

/// The box, wider by that much on each side.
inline Eigen::AlignedBox3f Grown(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& by) {
  return {box.min() - by, box.max() + by};
}

/// Whether a mover keeps light away: clear panes do not.
inline bool CastsShadow(const Instant& instant, std::size_t mover) {
  return instant.snapshot().movers[mover].casts_shadow;
}

/// The static world, and the movers that keep light away: what light and mirrored rays meet.
GeometryMask SolidOf(const Instant& instant);

/// Movers that may stand between any point of a box and any point of a rectangle: the segment
/// between their middles, thickened by whichever is larger, must meet the mover's box.
GeometryMask MoversBetween(const Instant& instant, const Eigen::AlignedBox3f& box,
                           const Eigen::Vector3f& center, const Eigen::Vector3f& half_u,
                           const Eigen::Vector3f& half_v);

/// The space that segments from a box to a rectangle pass, and a little around it: at each share of
/// the way it is a box between the two.
class Shaft {
 public:
  Shaft(const Eigen::AlignedBox3f& from, const Eigen::Vector3f& center,
        const Eigen::Vector3f& half_u, const Eigen::Vector3f& half_v);

  /// False only if no segment comes within a millimetre of the box.
  bool Meets(const Eigen::AlignedBox3f& box) const;

 private:
  Eigen::AlignedBox3f from_;
  Eigen::Vector3f low_way_, high_way_;  ///< of the box's corners
};

/// Those of the movers whose boxes the shaft meets.
GeometryMask MoversIn(const Shaft& shaft, const Instant& instant, GeometryMask movers);

/// Eight segments from + t·to, t in [0, t_far]; lanes that are not valid do not count.
struct Segments8 {
  F8x3 from, to;
  F8 t_far;
  I8 valid;
};

/// Those of the geometries that any of the segments may meet: the static world, if it is among
/// them, and the movers whose boxes they meet.
GeometryMask MayMeet(const Instant& instant, GeometryMask geometries, const Segments8& segments);

/// Sets, by packet, the lanes (as bits) of whose segments the geometries block some: those of the
/// static world first, each mover's for the lanes alone that are open and meet its box. Packets
/// side by side cost less than one by one.
void FindBlocked(const Instant& instant, GeometryMask geometries, Coherence coherence,
                 std::span<const Segments8> packets, std::span<unsigned> blocked);
/// The same for one packet.
unsigned Blocked(const Instant& instant, GeometryMask geometries, Coherence coherence,
                 const Segments8& segments);

}  // namespace aisle::sim
