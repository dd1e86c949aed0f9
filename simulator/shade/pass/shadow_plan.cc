#include "simulator/shade/pass/shadow_plan.h"

#include <algorithm>

#include "simulator/shade/pass/mover_blockers.h"
#include "simulator/shade/pass/static_pixels.h"

namespace aisle::sim {
namespace {

// Lights that together give less than this share of a tile's light are let through.
constexpr float kUntracedShare = 0.02f;
// A light that gives less than such a share of a tile's light is asked in every second, every
// fourth row of the pattern only.
constexpr float kHalfShare = 0.2f, kQuarterShare = 0.08f;

/// Around what the tile shows of the static world.
Eigen::AlignedBox3f BoxOf(const StaticPixels& pixels, const Tile& tile) {
  const F8 infinity = Wide(kInfinity);
  F8x3 lo = {infinity, infinity, infinity}, hi = {-infinity, -infinity, -infinity};
  ForRows(tile, kLanes, [&](int x, int y) {
    const I8 active = pixels.Lanes(x, y);
    const F8x3 p = pixels.PositionsOf(x, y, active);
    const auto extend = [&](F8 value, F8* low, F8* high) {
      *low = Min(*low, Select(active, value, infinity));
      *high = Max(*high, Select(active, value, -infinity));
    };
    extend(p.x, &lo.x, &hi.x);
    extend(p.y, &lo.y, &hi.y);
    extend(p.z, &lo.z, &hi.z);
  });
  Eigen::AlignedBox3f box;
  for (int k = 0; k < kLanes; ++k) {
    if (lo.x[k] > hi.x[k]) continue;
    box.extend(Eigen::Vector3f(lo.x[k], lo.y[k], lo.z[k]));
    box.extend(Eigen::Vector3f(hi.x[k], hi.y[k], hi.z[k]));
  }
  return box;
}

/// Bound of what a light can give to any point of a box, whichever way it faces.
float MostLight(const AreaLight& light, float scale, const Eigen::AlignedBox3f& box) {
  const float power = 4 * light.half_u.cross(light.half_v).norm() * light.radiance * scale;
  const Eigen::Vector3f normal = light.half_u.cross(light.half_v).normalized();
  float below = 0;  // how far the box reaches to the side the light shines to
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3f p = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner));
    below = std::max(below, (p - light.center).dot(normal));
  }
  const float squared = std::max(box.squaredExteriorDistance(light.center), 0.01f);
  return power * std::min(1.0f, below / std::sqrt(squared)) / squared;
}

float MeanLight(const HitImage& image, std::span<const float> irradiance, const Tile& tile) {
  float sum = 0, count = 0;
  for (int y = tile.y0; y < tile.y1; y += 2) {
    for (int x = tile.x0; x < tile.x1; x += 2) {
      const std::size_t i = image.Index(x, y);
      if (image.geometry[i] != 0) continue;
      sum += irradiance[i];
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

/// Drops the lights that hardly count, and thins the rays to the weak ones.
void Thin(float mean, std::vector<ShadowBlocker>* blockers) {
  std::ranges::sort(*blockers, [](const ShadowBlocker& a, const ShadowBlocker& b) {
    return a.most != b.most ? a.most < b.most : a.light < b.light;
  });
  float dropped = 0;
  std::erase_if(*blockers, [&](const ShadowBlocker& blocker) {
    dropped += blocker.most;
    return dropped < kUntracedShare * mean;
  });
  for (ShadowBlocker& blocker : *blockers) {
    blocker.row_step = blocker.most < kQuarterShare * mean ? 4
                       : blocker.most < kHalfShare * mean  ? 2
                                                           : 1;
  }
}

}  // namespace

ShadowPlan PlanShadows(const ShadingView& shading, std::span<const float> irradiance,
                       const Tile& tile) {
  ShadowPlan work;
  const Eigen::AlignedBox3f box = BoxOf(StaticPixels(shading), tile);
  if (box.isEmpty()) return work;
  const auto& movers = shading.instant.mover_boxes();
  for (std::size_t m = 0; m < movers.size(); ++m) {
    if (!CastsShadow(shading.instant, m)) continue;
    if (Grown(movers[m], Eigen::Vector3f::Constant(kAmbientReach)).intersects(box)) {
      work.near |= MoverBit(m);
    }
  }
  for (std::size_t l = 0; l < shading.world().lights().size(); ++l) {
    const AreaLight& light = shading.world().lights()[l];
    const float scale = shading.instant.snapshot().light_scale[l];
    if (scale <= 0) continue;
    const GeometryMask mask =
        MoversBetween(shading.instant, box, light.center, light.half_u, light.half_v);
    if (mask) work.blockers.push_back({l, mask, MostLight(light, scale, box), 1});
  }
  Thin(MeanLight(shading.image, irradiance, tile), &work.blockers);
  return work;
}

}  // namespace aisle::sim
