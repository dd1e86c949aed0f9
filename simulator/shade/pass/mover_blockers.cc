#include "simulator/shade/pass/mover_blockers.h"

#include <algorithm>

#include "simulator/shade/lanes/ray_packets.h"

namespace aisle::sim {
namespace {

constexpr float kAroundShaft = 4e-3f;  // m; points are lifted off their surfaces by half of that
constexpr float kStraight = 1e-3f;     // m: an end of a shaft that hardly moves aside

/// Narrows [near, far] to the shares t of the way where t·way <= most.
bool Narrow(float way, float most, float* near, float* far) {
  if (way > kStraight) {
    *far = std::min(*far, most / way);
  } else if (way < -kStraight) {
    *near = std::max(*near, most / way);
  } else if (most < -kStraight) {
    return false;
  }
  return *near <= *far;
}

}  // namespace

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

Shaft::Shaft(const Eigen::AlignedBox3f& from, const Eigen::Vector3f& center,
             const Eigen::Vector3f& half_u, const Eigen::Vector3f& half_v)
    : from_(Grown(from, Eigen::Vector3f::Constant(kAroundShaft))) {
  const Eigen::Vector3f half = half_u.cwiseAbs() + half_v.cwiseAbs();
  low_way_ = center - half - from_.min();
  high_way_ = center + half - from_.max();
}

bool Shaft::Meets(const Eigen::AlignedBox3f& box) const {
  float near = 0, far = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const float below = box.max()[axis] + kAroundShaft - from_.min()[axis];
    const float above = from_.max()[axis] - (box.min()[axis] - kAroundShaft);
    if (!Narrow(low_way_[axis], below, &near, &far)) return false;
    if (!Narrow(-high_way_[axis], above, &near, &far)) return false;
  }
  return true;
}

GeometryMask MoversIn(const Shaft& shaft, const Instant& instant, GeometryMask movers) {
  GeometryMask met = 0;
  for (std::size_t m = 0; m < instant.mover_boxes().size(); ++m) {
    if (movers & MoverBit(m) && shaft.Meets(instant.mover_boxes()[m])) met |= MoverBit(m);
  }
  return met;
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
