#include "simulator/shade/pass/beam_light.h"

#include <cmath>

#include "simulator/common/parallel.h"
#include "simulator/shade/pass/mover_blockers.h"
#include "simulator/shade/surface/normal_map.h"

namespace aisle::sim {
namespace {

constexpr float kLift = 2e-3f;  // m off the surface, so that a ray does not meet it
constexpr float kSoftest = 1e-4f;

F8 Clamp01(F8 x) { return Min(Max(x, Wide(0)), Wide(1)); }

F8 SmoothStep(F8 x) {
  const F8 t = Clamp01(x);
  return t * t * (3 - 2 * t);
}

/// Share of the sun that a row of `panes` bays lets through at `along`, where the window is
/// [-1, 1]: how much of what lies within `soft` (bays) of there is open.
F8 ThroughBays(F8 along, int panes, float bar, F8 soft) {
  const F8 bays = static_cast<float>(panes) * (along + 1) * 0.5f;
  const F8 bay = Floor(bays), at = bays - bay;
  const float open = std::max(0.0f, 1 - bar);
  // Bays that are open between this one's beginning and `to`; small numbers keep their digits.
  const auto open_until = [&](F8 to) {
    const F8 within = Min(Max(to, -bay), static_cast<float>(panes) - bay);
    const F8 whole = Floor(within);
    return whole * open + Min(Max(within - whole - bar / 2, Wide(0)), Wide(open));
  };
  return (open_until(at + soft) - open_until(at - soft)) / (2 * soft);
}

}  // namespace

BeamLight::BeamLight(const Instant& instant) : instant_(instant), blockers_(SolidOf(instant)) {}

/// `way`: from the place towards the light; `share`: of it that is free to trace.
F8 BeamLight::Unshadowed(const Beam& beam, const F8x3& position, const F8x3& normal, F8x3* way,
                         F8* share) const {
  const F8x3 to = Minus(Wide3(beam.origin), position);
  const F8x3 toward = Wide3(beam.toward);
  if (beam.kind == Beam::Kind::kSpot) {
    const F8 squared = Max(Dot(to, to), Wide(Beam::kHousing_m * Beam::kHousing_m)),
             distance = Sqrt(squared);
    const F8 along = -Dot(to, toward) / distance;
    const F8 edge =
        SmoothStep((along - beam.cos_outer) / std::max(beam.cos_inner - beam.cos_outer, 1e-5f));
    *way = to;
    *share = Max(1 - Beam::kHousing_m / distance, Wide(0));
    return beam.power * edge * Max(Dot(to, normal), Wide(0)) / (squared * distance);
  }
  const Eigen::Vector3f plane = beam.half_u.cross(beam.half_v).normalized();
  const float across = plane.dot(beam.toward);
  if (std::abs(across) < 1e-4f) return Wide(0);
  const F8 distance = Dot(to, Wide3(plane)) / across;
  const F8x3 meets = {distance * toward.x - to.x, distance * toward.y - to.y,
                      distance * toward.z - to.z};  // from the window's middle
  const F8 soft = distance * Beam::kSunRadius;
  const auto through = [&](const Eigen::Vector3f& half, int panes, float bar) {
    const float length = half.norm();
    const F8 blur = Max(soft * (static_cast<float>(panes) / (2 * length)), Wide(kSoftest));
    return ThroughBays(Dot(meets, Wide3(half / (length * length))), panes, bar, blur);
  };
  *way = {distance * toward.x, distance * toward.y, distance * toward.z};
  *share = Max(1 - Beam::kBeforeWindow_m / Max(distance, Wide(Beam::kBeforeWindow_m)), Wide(0));
  const F8 open =
      through(beam.half_u, beam.columns, beam.bar_u) * through(beam.half_v, beam.rows, beam.bar_v);
  const F8 light = beam.power * open * Max(Dot(toward, normal), Wide(0));
  return Select(distance > 0, light, Wide(0));
}

F8 BeamLight::At(const F8x3& position, const F8x3& normal, I8 valid) const {
  F8 sum = Wide(instant_.snapshot().beam_bounce);
  const F8x3 lifted = {position.x + kLift * normal.x, position.y + kLift * normal.y,
                       position.z + kLift * normal.z};
  for (const Beam& beam : instant_.snapshot().beams) {
    F8x3 way = {Wide(0), Wide(0), Wide(1)};
    F8 share = Wide(0);
    const F8 light = Unshadowed(beam, lifted, normal, &way, &share);
    const I8 lit = valid & (light > 0);
    if (!Any(lit)) continue;
    const unsigned blocked =
        Blocked(instant_, blockers_, Coherence::kCoherent, {lifted, way, share, lit});
    sum += Select(lit & ~LanesOf(blocked), light, Wide(0));
  }
  return Select(valid, sum, Wide(0));
}

void TraceBeams(const ShadingView& shading, std::vector<float>* irradiance) {
  const HitImage& image = shading.image;
  irradiance->assign(image.t.size(), 0);
  const BeamLight beams(shading.instant);
  const PixelRays& rays = *shading.view.rays;
  ParallelFor(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; x += kLanes) {
      const std::size_t first = image.Index(x, y);
      F8x3 position = {Wide(0), Wide(0), Wide(0)}, normal = {Wide(0), Wide(0), Wide(1)};
      I8 valid{};
      for (int k = 0; k < kLanes && x + k < image.width; ++k) {
        const std::size_t i = first + static_cast<std::size_t>(k);
        if (image.geometry[i] == kNoGeometry) continue;
        // A luminaire outshines by far what it reflects.
        if (image.geometry[i] == 0 && shading.tables.statics()[image.primitive[i]].f0 < 0) continue;
        const MeshPlace place = shading.tables.PlaceOf(shading.instant, image, i);
        const Eigen::Vector3f ray = shading.view.rotation * rays.At(x + k, y).homogeneous();
        Eigen::Vector3f n = SmoothNormal(place);
        if (n.dot(ray) > 0) n = -n;
        const Eigen::Vector3f p = shading.view.origin + image.t[i] * ray;
        position.x[k] = p.x(), position.y[k] = p.y(), position.z[k] = p.z();
        normal.x[k] = n.x(), normal.y[k] = n.y(), normal.z[k] = n.z();
        valid[k] = -1;
      }
      if (!Any(valid)) continue;
      const F8 light = beams.At(position, normal, valid);
      for (int k = 0; k < kLanes && x + k < image.width; ++k) {
        (*irradiance)[first + static_cast<std::size_t>(k)] = light[k];
      }
    }
  });
}

F8 BeamsAtHits(const ShadingView& shading, const BeamLight& beams, const Rays8& rays,
               const Hits8& hits) {
  F8x3 position = {Wide(0), Wide(0), Wide(0)}, normal = {Wide(0), Wide(0), Wide(1)};
  I8 valid{};
  for (int k = 0; k < kLanes; ++k) {
    const std::uint32_t geometry = hits.geometry[k];
    if (!rays.valid[k] || geometry == kNoGeometry) continue;
    const bool is_static = geometry == 0;
    const std::size_t base =
        is_static ? 0 : static_cast<std::size_t>(shading.tables.mover_bases()[geometry - 1]);
    const SurfaceRecord& record =
        (is_static ? shading.tables.statics()
                   : shading.frame.mover_records)[base + hits.primitive[k]];
    if (record.f0 < 0) continue;
    const float side = record.normal[0] * rays.dx[k] + record.normal[1] * rays.dy[k] +
                                   record.normal[2] * rays.dz[k] >
                               0
                           ? -1.0f
                           : 1.0f;
    position.x[k] = rays.ox[k] + hits.t[k] * rays.dx[k];
    position.y[k] = rays.oy[k] + hits.t[k] * rays.dy[k];
    position.z[k] = rays.oz[k] + hits.t[k] * rays.dz[k];
    normal.x[k] = side * record.normal[0];
    normal.y[k] = side * record.normal[1];
    normal.z[k] = side * record.normal[2];
    valid[k] = -1;
  }
  return Any(valid) ? beams.At(position, normal, valid) : Wide(0);
}

}  // namespace aisle::sim
