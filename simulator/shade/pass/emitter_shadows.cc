#include "simulator/shade/pass/emitter_shadows.h"

#include <array>

#include "simulator/common/parallel.h"
#include "simulator/shade/light/emitter_rays.h"
#include "simulator/shade/pass/mover_blockers.h"

namespace aisle::sim {
namespace {

constexpr float kRaysPerShare = 32;
constexpr int kMostRays = 16;
// Emitters that give less are taken to be seen as well as the others.
constexpr float kUntracedShare = 0.005f;

/// Eight places, and where the rays of each end on an emitter, which is the same on all emitters.
struct AskingPlaces {
  AskingPlaces(std::span<const ShadowedPlace> eight, int most_rays) : places(eight) {
    for (int ray = 0; ray < most_rays; ++ray) ends.push_back(places.PlaceOnEmitter(ray));
    for (const ShadowedPlace& place : eight) box.extend(place.surface.position);
  }
  Places8 places;
  std::vector<std::pair<F8, F8>> ends;
  Eigen::AlignedBox3f box;
};

/// What eight places see of one emitter.
F8 TraceEmitter(const Instant& instant, const Emitters::Emitter& e, const EmitterRays& plan,
                const AskingPlaces& asking) {
  const Places8& places = asking.places;
  const F8x3 n = {Wide(e.normal.x()), Wide(e.normal.y()), Wide(e.normal.z())};
  const GeometryMask movers =
      MoversIn(Shaft(asking.box, e.center, e.half_u, e.half_v), instant, plan.movers);
  const auto rays = static_cast<std::size_t>(plan.rays);
  std::array<Segments8, kMostRays> ways;
  std::array<unsigned, kMostRays> blocked;
  for (std::size_t ray = 0; ray < rays; ++ray) {
    const F8x3 to = Minus(PointsOn(e, asking.ends[ray]), places.position);
    const I8 valid = places.valid & (Dot(to, places.normal) > 0) & (Dot(to, n) < 0);
    ways[ray] = {places.position, to, Wide(kAlmostAtEmitter), valid};
  }
  FindBlocked(instant, movers, Coherence::kCoherent, std::span(ways).first(rays), blocked);
  F8 seen = Wide(0), asked = Wide(0);
  for (std::size_t ray = 0; ray < rays; ++ray) {
    const I8 valid = ways[ray].valid;
    asked += Select(valid, Wide(1), Wide(0));
    seen += Select(valid & ~LanesOf(blocked[ray]), Wide(1), Wide(0));
  }
  return Select(asked > 0, seen / Max(asked, Wide(1)), Wide(EmitterVisibility::kBelowHorizon));
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
  int most_rays = 0;
  for (const EmitterRays& one : plan) most_rays = std::max(most_rays, one.rays);
  ParallelFor(std::size_t{0}, (places.size() + kLanes - 1) / kLanes, [&](std::size_t packet) {
    const std::size_t first = packet * kLanes;
    const std::span eight =
        places.subspan(first, std::min<std::size_t>(kLanes, places.size() - first));
    const AskingPlaces asking(eight, most_rays);
    for (std::size_t i = 0; i < plan.size(); ++i) {
      if (plan[i].rays == 0) continue;
      const F8 seen = TraceEmitter(instant, emitters[i], plan[i], asking);
      for (std::size_t k = 0; k < eight.size(); ++k) {
        visible.Row(first + k)[i] = seen[static_cast<int>(k)];
      }
    }
    for (std::size_t k = 0; k < eight.size(); ++k) FillUnasked(plan, visible.Row(first + k));
  });
  return visible;
}

}  // namespace aisle::sim
