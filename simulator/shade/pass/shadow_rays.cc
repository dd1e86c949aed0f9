#include "simulator/shade/pass/shadow_rays.h"

#include <algorithm>

#include "simulator/shade/lanes/frame8.h"
#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/pass/mover_blockers.h"

namespace aisle::sim {
namespace {

constexpr float kMoverReflection = 0.3f;  // what blocking parts of a mover send on in turn
const F8 kAlmostThere = Wide(0.998f);     // of the way to a light

/// From eight points to places on a light, and the irradiance that it gives if nothing stands
/// between.
struct WaysToLight {
  Segments8 ways;
  F8 light;
};

WaysToLight WaysTo(const AreaLight& light, float scale, const StaticPoints8& points, F8 a, F8 b) {
  const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
  const F8x3 on_light = {light.center.x() + a * light.half_u.x() + b * light.half_v.x(),
                         light.center.y() + a * light.half_u.y() + b * light.half_v.y(),
                         light.center.z() + a * light.half_u.z() + b * light.half_v.z()};
  const F8x3 to = Minus(on_light, points.position);
  const F8 here = Dot(to, points.normal), there = -Dot(to, Wide3(cross)), squared = Dot(to, to);
  const float power = 4 * light.radiance * scale;
  return {{points.position, to, kAlmostThere, points.active & (here > 0) & (there > 0)},
          power * here * there / (squared * squared)};
}

}  // namespace

ShadowRays::Pattern::Pattern() {
  const std::vector<Eigen::Vector3f> ambient = CosineDirections(kPatternSize * kAmbientRays);
  for (std::size_t y = 0; y < kRows; ++y) {
    for (int k = 0; k < kLanes; ++k) {
      const int index = PatternIndex(k, static_cast<int>(y));
      const Eigen::Vector2f s = SpreadPoint(index);
      rows[y].a[k] = 2 * s.x() - 1;
      rows[y].b[k] = 2 * s.y() - 1;
      for (std::size_t ray = 0; ray < kAmbientRays; ++ray) {
        const Eigen::Vector3f& d = ambient[static_cast<std::size_t>(index) + ray * kPatternSize];
        rows[y].local_ambient[ray].x[k] = d.x();
        rows[y].local_ambient[ray].y[k] = d.y();
        rows[y].local_ambient[ray].z[k] = d.z();
      }
    }
  }
}

/// Irradiance that movers keep from one light, by one shadow ray a point.
void ShadowRays::AddDirect(const ShadowBlocker& blocker, std::span<const ShadowedPoints8> packets,
                           std::span<F8> lost) const {
  const AreaLight& light = shading_.world().lights()[blocker.light];
  const float scale = shading_.instant.snapshot().light_scale[blocker.light];
  std::array<Segments8, kMostPackets> ways;
  std::array<F8, kMostPackets> given;
  std::array<std::size_t, kMostPackets> of_packet;
  std::size_t count = 0;
  for (std::size_t p = 0; p < packets.size(); ++p) {
    // Which rows differs from light to light, so that the work of the rows is alike.
    const auto row = static_cast<std::size_t>(packets[p].row);
    if ((row + blocker.light) % blocker.row_step != 0) continue;
    const Pattern::Row& at = pattern_.At(packets[p].row);
    const WaysToLight found = WaysTo(light, scale, packets[p].points, at.a, at.b);
    if (!Any(found.ways.valid)) continue;
    ways[count] = found.ways;
    given[count] = found.light;
    of_packet[count++] = p;
  }
  const std::span asked = std::span(ways).first(count);
  std::array<unsigned, kMostPackets> blocked, dark;
  FindBlocked(shading_.instant, blocker.movers, Coherence::kCoherent, asked, blocked);
  // What the static world keeps away anyway is not the mover's to take.
  for (std::size_t i = 0; i < count; ++i) ways[i].valid = LanesOf(blocked[i]);
  FindBlocked(shading_.instant, kStaticOnly, Coherence::kCoherent, asked, dark);
  for (std::size_t i = 0; i < count; ++i) {
    lost[of_packet[i]] += Select(LanesOf(blocked[i] & ~dark[i]), given[i], Wide(0)) *
                          static_cast<float>(blocker.row_step);
  }
}

/// Indirect irradiance that movers keep away, by a few short rays a point.
void ShadowRays::AddIndirect(GeometryMask movers, std::span<const ShadowedPoints8> packets,
                             std::span<F8> lost) const {
  std::array<Segments8, kAmbientRays * kMostPackets> ways;
  for (std::size_t p = 0; p < packets.size(); ++p) {
    const StaticPoints8& points = packets[p].points;
    const Frame8 basis(points.normal);
    for (std::size_t ray = 0; ray < kAmbientRays; ++ray) {
      const F8x3 way = basis.ToWorld(pattern_.At(packets[p].row).local_ambient[ray]);
      ways[kAmbientRays * p + ray] = {
          points.position,
          {kAmbientReach * way.x, kAmbientReach * way.y, kAmbientReach * way.z},
          Wide(1),
          points.active};
    }
  }
  std::array<unsigned, kAmbientRays * kMostPackets> met;
  FindBlocked(shading_.instant, movers, Coherence::kIncoherent,
              std::span(ways).first(kAmbientRays * packets.size()), met);
  for (std::size_t p = 0; p < packets.size(); ++p) {
    F8 blocked = Wide(0);
    for (std::size_t ray = 0; ray < kAmbientRays; ++ray) {
      blocked += Select(LanesOf(met[kAmbientRays * p + ray]), Wide(1), Wide(0));
    }
    if (!Any(blocked > 0)) continue;
    lost[p] += IndirectAt(packets[p], blocked > 0) * blocked *
               ((1 - kMoverReflection) / static_cast<float>(kAmbientRays));
  }
}

/// What of the points' irradiance is indirect, 0 where that is not wanted.
F8 ShadowRays::IndirectAt(const ShadowedPoints8& packet, I8 wanted) const {
  F8 indirect = Wide(0);
  for (int k = 0; k < kLanes; ++k) {
    if (!wanted[k]) continue;
    const auto triangle = static_cast<std::size_t>(packet.points.primitive[k]);
    const float direct =
        ReadLight(shading_.tables.statics()[triangle].light, shading_.frame.statics->direct,
                  packet.points.u[k], packet.points.v[k]);
    indirect[k] = std::max(0.0f, packet.irradiance[k] - direct);
  }
  return indirect;
}

void ShadowRays::FindLost(std::span<const ShadowedPoints8> packets, const ShadowPlan& plan,
                          std::span<F8> lost) const {
  std::ranges::fill(lost.first(packets.size()), Wide(0));
  for (const ShadowBlocker& blocker : plan.blockers) AddDirect(blocker, packets, lost);
  if (plan.near) AddIndirect(plan.near, packets, lost);
}

}  // namespace aisle::sim
