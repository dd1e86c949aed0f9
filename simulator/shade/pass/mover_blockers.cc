#include "simulator/shade/pass/mover_blockers.h"

#include <algorithm>
#include <array>

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

/// Packets of segments that are asked together, and who wants to know.
class Asking {
 public:
  Asking(const Instant& instant, Coherence coherence, std::span<unsigned> blocked)
      : instant_(instant), coherence_(coherence), blocked_(blocked) {}

  void Add(const Segments8& segments, I8 valid, std::size_t packet, GeometryMask geometries) {
    rays_[count_] = MakeRays(segments.from, segments.to, segments.t_far, valid);
    packets_[count_++] = packet;
    if (count_ == rays_.size()) Ask(geometries);
  }

  void Ask(GeometryMask geometries) {
    if (count_ == 0) return;
    std::array<unsigned, Instant::kMostPackets> found;
    instant_.Occluded(std::span(rays_).first(count_), coherence_, geometries, found);
    for (std::size_t i = 0; i < count_; ++i) blocked_[packets_[i]] |= found[i];
    count_ = 0;
  }

 private:
  const Instant& instant_;
  Coherence coherence_;
  std::span<unsigned> blocked_;
  std::array<Rays8, Instant::kMostPackets> rays_;
  std::array<std::size_t, Instant::kMostPackets> packets_;
  std::size_t count_ = 0;
};

}  // namespace

GeometryMask SolidOf(const Instant& instant) {
  GeometryMask solid = kEverything;
  for (std::size_t m = 0; m < instant.snapshot().movers.size(); ++m) {
    if (!CastsShadow(instant, m)) solid &= ~MoverBit(m);
  }
  return solid;
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

GeometryMask MayMeet(const Instant& instant, GeometryMask geometries, const Segments8& segments) {
  GeometryMask met = geometries & kStaticOnly;
  for (std::size_t m = 0; m < instant.mover_boxes().size(); ++m) {
    if (!(geometries & MoverBit(m))) continue;
    const I8 meet = MeetBox(instant.mover_boxes()[m], segments.from, segments.to, segments.t_far);
    if (Any(segments.valid & meet)) met |= MoverBit(m);
  }
  return met;
}

void FindBlocked(const Instant& instant, GeometryMask geometries, Coherence coherence,
                 std::span<const Segments8> packets, std::span<unsigned> blocked) {
  std::fill_n(blocked.begin(), packets.size(), 0u);
  Asking asking(instant, coherence, blocked);
  if (geometries & kStaticOnly) {
    for (std::size_t p = 0; p < packets.size(); ++p) {
      if (Any(packets[p].valid)) asking.Add(packets[p], packets[p].valid, p, kStaticOnly);
    }
    asking.Ask(kStaticOnly);
  }
  for (std::size_t m = 0; m < instant.mover_boxes().size(); ++m) {
    if (!(geometries & MoverBit(m))) continue;
    for (std::size_t p = 0; p < packets.size(); ++p) {
      const Segments8& segments = packets[p];
      const I8 open = segments.valid & ~LanesOf(blocked[p]);
      const I8 meet =
          open & MeetBox(instant.mover_boxes()[m], segments.from, segments.to, segments.t_far);
      if (Any(meet)) asking.Add(segments, meet, p, MoverBit(m));
    }
    asking.Ask(MoverBit(m));
  }
}

unsigned Blocked(const Instant& instant, GeometryMask geometries, Coherence coherence,
                 const Segments8& segments) {
  unsigned blocked = 0;
  FindBlocked(instant, geometries, coherence, {&segments, 1}, {&blocked, 1});
  return blocked;
}

}  // namespace aisle::sim
