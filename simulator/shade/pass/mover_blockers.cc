#include "simulator/shade/pass/mover_blockers.h"

#include "simulator/shade/lanes/ray_packets.h"

namespace aisle::sim {

I8 MeetBox(const Eigen::AlignedBox3f& box, const F8x3& from, const F8x3& to) {
  F8 near = Wide(0), far = Wide(1);
  const auto slab = [&](float lo, float hi, F8 start, F8 along) {
    const F8 safe = Select(Abs(along) < 1e-9f, Wide(1e-9f), along);
    const F8 a = (lo - start) / safe, b = (hi - start) / safe;
    near = Max(near, Min(a, b));
    far = Min(far, Max(a, b));
  };
  slab(box.min().x(), box.max().x(), from.x, to.x);
  slab(box.min().y(), box.max().y(), from.y, to.y);
  slab(box.min().z(), box.max().z(), from.z, to.z);
  return near <= far;
}

GeometryMask MoversBetween(const Instant& instant, const Eigen::AlignedBox3f& box,
                           const Eigen::Vector3f& center, const Eigen::Vector3f& half_u,
                           const Eigen::Vector3f& half_v) {
  const Eigen::Vector3f thick = (half_u.cwiseAbs() + half_v.cwiseAbs()).cwiseMax(box.sizes() / 2);
  const Eigen::Vector3f start = box.center(), way = center - start;
  const F8x3 from = {Wide(start.x()), Wide(start.y()), Wide(start.z())};
  const F8x3 to = {Wide(way.x()), Wide(way.y()), Wide(way.z())};
  GeometryMask mask = 0;
  for (std::size_t m = 0; m < instant.mover_boxes().size(); ++m) {
    if (!CastsShadow(instant, m)) continue;
    if (Any(MeetBox(Grown(instant.mover_boxes()[m], thick), from, to))) mask |= MoverBit(m);
  }
  return mask;
}

unsigned BlockedByMovers(const Instant& instant, GeometryMask movers, const F8x3& from,
                         const F8x3& to, F8 t_far, I8 valid) {
  unsigned blocked = 0;
  for (std::size_t m = 0; m < instant.mover_boxes().size(); ++m) {
    if (!(movers & MoverBit(m))) continue;
    const I8 open = valid & ~LanesOf(blocked);
    const I8 meet = open & MeetBox(instant.mover_boxes()[m], from, to);
    if (!Any(meet)) continue;
    blocked |= instant.Occluded(MakeRays(from, to, t_far, meet), Coherence::kCoherent, MoverBit(m));
  }
  return blocked;
}

}  // namespace aisle::sim
