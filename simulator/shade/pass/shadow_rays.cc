#include "simulator/shade/pass/shadow_rays.h"

#include "simulator/shade/lanes/frame8.h"
#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/lanes/ray_packets.h"
#include "simulator/shade/pass/mover_blockers.h"

namespace aisle::sim {
namespace {

constexpr float kMoverReflection = 0.3f;  // what blocking parts of a mover send on in turn
const F8 kAlmostThere = Wide(0.998f);     // of the way to a light

F8x3 Wide3(const Eigen::Vector3f& v) { return {Wide(v.x()), Wide(v.y()), Wide(v.z())}; }

}  // namespace

ShadowRays::Pattern::Pattern() {
  const std::vector<Eigen::Vector3f> ambient = CosineDirections(kPatternSize * kAmbientRays);
  for (std::size_t y = 0; y < 4; ++y) {
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

/// Lanes whose segment meets the box of any of the movers.
I8 ShadowRays::MayMeet(GeometryMask movers, const F8x3& from, const F8x3& to) const {
  I8 may{};
  for (std::size_t m = 0; m < shading_.instant.mover_boxes().size(); ++m) {
    if (movers & MoverBit(m)) may |= MeetBox(shading_.instant.mover_boxes()[m], from, to);
  }
  return may;
}

/// Nothing darkens a luminaire, whose own radiance outshines what it reflects by far.
I8 ShadowRays::OnLuminaires(std::size_t pixel, I8 lanes) const {
  constexpr int kStride = sizeof(SurfaceRecord) / sizeof(float);
  const I8 record = lanes ? LoadI(&shading_.image.primitive[pixel]) : I8{};
  return Gather(&shading_.tables.statics()[0].f0, record * kStride) < 0;
}

/// Irradiance that movers keep from one light, by one shadow ray a pixel.
F8 ShadowRays::LostDirect(const ShadowBlocker& blocker, const Pixels8& pixels,
                          const Pattern::Row& at) const {
  const AreaLight& light = shading_.world().lights()[blocker.light];
  const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
  const F8x3 on_light = {light.center.x() + at.a * light.half_u.x() + at.b * light.half_v.x(),
                         light.center.y() + at.a * light.half_u.y() + at.b * light.half_v.y(),
                         light.center.z() + at.a * light.half_u.z() + at.b * light.half_v.z()};
  const F8x3 to = Minus(on_light, pixels.position);
  const F8 here = Dot(to, pixels.normal), there = -Dot(to, Wide3(cross));
  const I8 valid = pixels.active & (here > 0) & (there > 0);
  if (!Any(valid)) return Wide(0);
  const unsigned blocked =
      BlockedByMovers(shading_.instant, blocker.movers, pixels.position, to, kAlmostThere, valid);
  if (!blocked) return Wide(0);
  // What the static world keeps away anyway is not the mover's to take.
  const unsigned dark =
      shading_.instant.Occluded(MakeRays(pixels.position, to, kAlmostThere, LanesOf(blocked)),
                                Coherence::kCoherent, kStaticOnly);
  const F8 squared = Dot(to, to);
  const float power = 4 * light.radiance * shading_.instant.snapshot().light_scale[blocker.light];
  return Select(LanesOf(blocked & ~dark), power * here * there / (squared * squared), Wide(0));
}

/// Indirect irradiance that movers keep away, by a few short rays a pixel.
F8 ShadowRays::LostIndirect(GeometryMask movers, const Pixels8& pixels, const Pattern::Row& at,
                            int x, int y) const {
  const Frame8 basis(pixels.normal);
  F8 blocked = Wide(0);
  for (const F8x3& d : at.local_ambient) {
    const F8x3 way = basis.ToWorld(d);
    const F8x3 to = {kAmbientReach * way.x, kAmbientReach * way.y, kAmbientReach * way.z};
    const I8 valid = pixels.active & MayMeet(movers, pixels.position, to);
    if (!Any(valid)) continue;
    const unsigned hit = shading_.instant.Occluded(MakeRays(pixels.position, to, Wide(1), valid),
                                                   Coherence::kIncoherent, movers);
    blocked += Select(LanesOf(hit), Wide(1), Wide(0));
  }
  if (!Any(blocked > 0)) return Wide(0);
  F8 lost = Wide(0);
  for (int k = 0; k < kLanes; ++k) {
    if (blocked[k] == 0) continue;
    const std::size_t i = shading_.image.Index(x + k, y);
    const LightPatch& patch = shading_.tables.statics()[shading_.image.primitive[i]].light;
    const float direct =
        ReadLight(patch, shading_.frame.statics->direct, shading_.image.u[i], shading_.image.v[i]);
    lost[k] = std::max(0.0f, irradiance_[i] - direct);
  }
  return lost * blocked * ((1 - kMoverReflection) / kAmbientRays);
}

bool ShadowRays::Trace(int x, int y, I8 lanes, const ShadowPlan& plan,
                       std::vector<float>* raw) const {
  const Pixels8 pixels = pixels_.Locate(x, y, lanes);
  const Pattern::Row& pattern = pattern_.rows[static_cast<std::size_t>(y & 3)];
  F8 lost = Wide(0);
  for (const ShadowBlocker& blocker : plan.blockers) {
    // Which rows differs from light to light, so that the work of the rows is alike.
    if ((static_cast<std::size_t>(y) + blocker.light) % blocker.row_step != 0) continue;
    lost += LostDirect(blocker, pixels, pattern) * static_cast<float>(blocker.row_step);
  }
  if (plan.near) lost += LostIndirect(plan.near, pixels, pattern, x, y);
  if (!Any(lost > 0)) return false;
  const std::size_t i = shading_.image.Index(x, y);
  const F8 kept = 1 - lost / Max(LoadF(&irradiance_[i]), Wide(1e-9f));
  Store(Select(lanes & ~OnLuminaires(i, lanes), kept, LoadF(&(*raw)[i])), &(*raw)[i]);
  return true;
}

}  // namespace aisle::sim
