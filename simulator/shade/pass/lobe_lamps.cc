#include "simulator/shade/pass/lobe_lamps.h"

#include "simulator/shade/pass/mover_blockers.h"
#include "simulator/shade/surface/gloss.h"

namespace aisle::sim {
namespace {

constexpr float kLightGuard = 0.01f;  // m: shadow rays end so far before the light's own surface
constexpr float kFloor = 0.02f;       // of a lamp's importance: none that could count is left out

F8x3 Scaled(const F8x3& v, F8 by) { return {v.x * by, v.y * by, v.z * by}; }

}  // namespace

LobeLamps::LobeLamps(const Instant& instant, std::span<const AreaLight> lights)
    : instant_(instant), blockers_(SolidOf(instant)) {
  const std::span<const float> light_scale = instant.snapshot().light_scale;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (light_scale[i] <= 0) continue;
    const AreaLight& light = lights[i];
    const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
    lamps_.push_back({light.center, light.half_u, light.half_v, cross.normalized(),
                      4 * cross.norm() * light.radiance * light_scale[i],
                      light.half_u.norm() + light.half_v.norm()});
  }
}

F8 LobeLamps::Importance(const Lamp& lamp, const LobePoints8& points) const {
  const F8x3 to = {lamp.center.x() - points.position.x, lamp.center.y() - points.position.y,
                   lamp.center.z() - points.position.z};
  const F8 squared = Max(Dot(to, to), Wide(1e-4f)), inverse = 1 / Sqrt(squared);
  const F8 there =
      -(lamp.normal.x() * to.x + lamp.normal.y() * to.y + lamp.normal.z() * to.z) * inverse;
  const F8x3 in = Scaled(points.basis.ToLocal(to), inverse);
  const F8x3 sum = {points.out.x + in.x, points.out.y + in.y, points.out.z + in.z};
  const F8 half_z = sum.z / Max(Sqrt(Dot(sum, sum)), Wide(1e-6f));
  // Half vectors turn by half the angle that the lamp takes.
  const F8 widened =
      Min(points.roughness * points.roughness + 0.5f * lamp.extent * inverse, Wide(1));
  const F8 lobe = FacetDensity(half_z, widened) + kFloor;
  const F8 above = Max(in.z + lamp.extent * inverse, Wide(0));
  return Max(there, Wide(0)) * above * lobe * (lamp.power / squared);
}

F8 LobeLamps::Mirrored(const LobePoints8& points, const LampChoice8& choice, I8 valid) const {
  thread_local std::vector<F8> cumulative;
  cumulative.clear();
  F8 total = Wide(0);
  for (const Lamp& lamp : lamps_) cumulative.push_back(total += Importance(lamp, points));
  valid &= total > 0;
  if (!Any(valid)) return Wide(0);

  const F8 target = choice.which * total;
  I8 chosen{};
  for (const F8& below : cumulative) chosen -= below <= target;
  chosen = MinInt(chosen, WideInt(static_cast<int>(lamps_.size()) - 1));
  F8x3 on_lamp{}, normal{};
  F8 weight = Wide(0);
  for (int k = 0; k < kLanes; ++k) {
    if (!valid[k]) continue;
    const auto i = static_cast<std::size_t>(chosen[k]);
    const Lamp& lamp = lamps_[i];
    const Eigen::Vector3f place =
        lamp.center + (2 * choice.a[k] - 1) * lamp.half_u + (2 * choice.b[k] - 1) * lamp.half_v;
    on_lamp.x[k] = place.x();
    on_lamp.y[k] = place.y();
    on_lamp.z[k] = place.z();
    normal.x[k] = lamp.normal.x();
    normal.y[k] = lamp.normal.y();
    normal.z[k] = lamp.normal.z();
    const float share = cumulative[i][k] - (i ? cumulative[i - 1][k] : 0.0f);
    weight[k] = share > 0 ? lamp.power * total[k] / share : 0.0f;
  }
  const F8x3 to = Minus(on_lamp, points.position);
  const F8 squared = Max(Dot(to, to), Wide(1e-4f)), distance = Sqrt(squared);
  const F8 there = -Dot(normal, to) / distance;
  const F8x3 in = Scaled(points.basis.ToLocal(to), 1 / distance);
  const F8 reflected = EvaluateLobe(points.f0, points.roughness, points.out, in).reflected;
  const F8 light = reflected * Max(there, Wide(0)) * weight / squared;
  valid &= light > 0;
  if (!Any(valid)) return Wide(0);
  const F8 t_far = 1 - kLightGuard / Max(distance, Wide(2 * kLightGuard));
  const unsigned blocked =
      Blocked(instant_, blockers_, Coherence::kIncoherent, {points.position, to, t_far, valid});
  return Select(valid & ~LanesOf(blocked), light, Wide(0));
}

}  // namespace aisle::sim
