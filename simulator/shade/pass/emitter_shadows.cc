#include "simulator/shade/pass/emitter_shadows.h"

#include <bit>
#include <cmath>

#include "simulator/common/parallel.h"
#include "simulator/shade/light/emitter_rays.h"
#include "simulator/shade/pass/mover_blockers.h"

namespace aisle::sim {
namespace {

constexpr float kRaysPerShare = 32;
constexpr int kMostRays = 16;
// Emitters that give less are taken to be seen as well as the others.
constexpr float kUntracedShare = 0.005f;

/// Writes what eight places see of one emitter.
void TraceEmitter(const Instant& instant, const Emitters& emitters, std::size_t emitter,
                  const EmitterRays& plan, const Places8& places, std::size_t count,
                  EmitterVisibility* out, std::size_t first) {
  const Emitters::Emitter& e = emitters[emitter];
  const F8x3 n = {Wide(e.normal.x()), Wide(e.normal.y()), Wide(e.normal.z())};
  F8 seen = Wide(0), asked = Wide(0);
  for (int ray = 0; ray < plan.rays; ++ray) {
    const F8x3 to = Minus(PointsOn(e, ray, places), places.position);
    const I8 valid = places.valid & (Dot(to, places.normal) > 0) & (Dot(to, n) < 0);
    if (!Any(valid)) continue;
    const unsigned blocked =
        BlockedByMovers(instant, plan.movers, places.position, to, Wide(kAlmostAtEmitter), valid);
    asked += Select(valid, Wide(1), Wide(0));
    seen += Select(valid & ~LanesOf(blocked), Wide(1), Wide(0));
  }
  for (std::size_t k = 0; k < count; ++k) {
    const int lane = static_cast<int>(k);
    out->Row(first + k)[emitter] =
        asked[lane] > 0 ? seen[lane] / asked[lane] : EmitterVisibility::kBelowHorizon;
  }
}

/// Gives emitters that were too weak to be asked the mean of the others.
void FillUnasked(std::span<const EmitterRays> plan, std::span<float> row) {
  float sum = 0, count = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i].unasked || row[i] == EmitterVisibility::kBelowHorizon) continue;
    sum += row[i];
    count += 1;
  }
  for (std::size_t i = 0; i < plan.size() && count > 0; ++i) {
    if (plan[i].unasked) row[i] = sum / count;
  }
}

}  // namespace

std::vector<EmitterRays> PlanEmitterRays(const Instant& instant, const Emitters& emitters,
                                         const Eigen::AlignedBox3f& box, GeometryMask movers) {
  const std::vector<float> shares = emitters.Shares(box.center(), instant.snapshot().light_scale);
  std::vector<EmitterRays> plan(emitters.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    plan[i].unasked = shares[i] < kUntracedShare;
    if (plan[i].unasked) continue;
    const Emitters::Emitter& e = emitters[i];
    plan[i].movers = movers & MoversBetween(instant, box, e.center, e.half_u, e.half_v);
    if (plan[i].movers) plan[i].rays = RaysForShare(shares[i], kRaysPerShare, 1, kMostRays);
  }
  return plan;
}

EmitterVisibility TraceMoverShadowsOn(const Instant& instant, const Emitters& emitters,
                                      std::span<const EmitterRays> plan,
                                      std::span<const ShadowedPlace> places) {
  EmitterVisibility visible(places.size(), emitters.stride());
  ParallelFor(std::size_t{0}, (places.size() + kLanes - 1) / kLanes, [&](std::size_t packet) {
    const std::size_t first = packet * kLanes;
    const std::span eight =
        places.subspan(first, std::min<std::size_t>(kLanes, places.size() - first));
    const Places8 lanes(eight);
    for (std::size_t i = 0; i < plan.size(); ++i) {
      if (plan[i].rays == 0) continue;
      TraceEmitter(instant, emitters, i, plan[i], lanes, eight.size(), &visible, first);
    }
    for (std::size_t k = 0; k < eight.size(); ++k) FillUnasked(plan, visible.Row(first + k));
  });
  return visible;
}

}  // namespace aisle::sim
