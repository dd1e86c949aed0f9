#include "simulator/shade/pass/shadow_plan.h"

#include <algorithm>
#include <bit>

#include "simulator/shade/pass/mover_blockers.h"
#include "simulator/shade/pass/static_pixels.h"

namespace aisle::sim {
namespace {

// Lights that together give less than this share of a tile's light are let through.
constexpr float kUntracedShare = 0.02f;
// A light that gives less than such a share of a tile's light is asked in every second, every
// fourth row of the pattern only.
constexpr float kHalfShare = 0.2f, kQuarterShare = 0.08f;

F8x3 Plus(const F8x3& a, const F8x3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
void SetLane(const Eigen::Vector3f& v, std::size_t k, F8x3* to) {
  to->x[k] = v.x();
  to->y[k] = v.y();
  to->z[k] = v.z();
}

/// Around what lanes(x, y) of the tile's packets show.
template <typename Lanes>
Eigen::AlignedBox3f BoxOf(const StaticPixels& pixels, const Tile& tile, const Lanes& lanes) {
  const F8 infinity = Wide(kInfinity);
  F8x3 lo = {infinity, infinity, infinity}, hi = {-infinity, -infinity, -infinity};
  ForRows(tile, kLanes, [&](int x, int y) {
    const I8 active = lanes(x, y);
    if (!Any(active)) return;
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

/// Drops the lights that hardly count.
void DropWeak(float mean, std::vector<ShadowBlocker>* blockers) {
  std::ranges::sort(*blockers, [](const ShadowBlocker& a, const ShadowBlocker& b) {
    return a.most != b.most ? a.most < b.most : a.light < b.light;
  });
  float dropped = 0;
  std::erase_if(*blockers, [&](const ShadowBlocker& blocker) {
    dropped += blocker.most;
    return dropped < kUntracedShare * mean;
  });
}

/// Thins the rays to the weak ones.
void ThinRows(float mean, std::vector<ShadowBlocker>* blockers) {
  for (ShadowBlocker& blocker : *blockers) {
    blocker.row_step = blocker.most < kQuarterShare * mean ? 4
                       : blocker.most < kHalfShare * mean  ? 2
                                                           : 1;
  }
}

}  // namespace

ShadowPlanner::ShadowPlanner(const ShadingView& shading) : shading_(shading) {
  const std::vector<AreaLight>& lights = shading.world().lights();
  lights_.resize((lights.size() + kLanes - 1) / kLanes);
  for (std::size_t i = 0; i < lights_.size() * kLanes; ++i) {
    const AreaLight& light = lights[std::min(i, lights.size() - 1)];
    const Eigen::Vector3f half_size = light.half_u.cwiseAbs() + light.half_v.cwiseAbs();
    Lights8& eight = lights_[i / kLanes];
    const std::size_t k = i % kLanes;
    SetLane(light.center, k, &eight.center);
    SetLane(half_size, k, &eight.half_size);
    const bool is_on = i < lights.size() && shading.instant.snapshot().light_scale[i] > 0;
    eight.is_on[k] = is_on ? -1 : 0;
  }
}

std::vector<GeometryMask> ShadowPlanner::MoversBefore(const Eigen::AlignedBox3f& box) const {
  const Instant& instant = shading_.instant;
  const Eigen::Vector3f start = box.center(), half = box.sizes() / 2;
  const F8x3 from = Wide3(start);
  std::vector<GeometryMask> movers(lights_.size() * kLanes);
  for (std::size_t packet = 0; packet < lights_.size(); ++packet) {
    const Lights8& lights = lights_[packet];
    if (!Any(lights.is_on)) continue;
    const F8x3 way = Minus(lights.center, from);
    const F8x3 thick = {Max(lights.half_size.x, Wide(half.x())),
                        Max(lights.half_size.y, Wide(half.y())),
                        Max(lights.half_size.z, Wide(half.z()))};
    for (std::size_t m = 0; m < instant.mover_boxes().size(); ++m) {
      if (!CastsShadow(instant, m)) continue;
      const Eigen::AlignedBox3f& mover = instant.mover_boxes()[m];
      const F8x3 low = Minus(Wide3(mover.min()), thick), high = Plus(Wide3(mover.max()), thick);
      unsigned met = Bits(lights.is_on & MeetBoxes(low, high, from, way));
      for (; met; met &= met - 1) {
        movers[packet * kLanes + static_cast<std::size_t>(std::countr_zero(met))] |= MoverBit(m);
      }
    }
  }
  return movers;
}

ShadowPlan ShadowPlanner::PlanAll(const Eigen::AlignedBox3f& box) const {
  ShadowPlan plan;
  const auto& movers = shading_.instant.mover_boxes();
  for (std::size_t m = 0; m < movers.size(); ++m) {
    if (!CastsShadow(shading_.instant, m)) continue;
    if (Grown(movers[m], Eigen::Vector3f::Constant(kAmbientReach)).intersects(box)) {
      plan.near |= MoverBit(m);
    }
  }
  const std::vector<AreaLight>& lights = shading_.world().lights();
  const std::vector<GeometryMask> before = MoversBefore(box);
  for (std::size_t l = 0; l < lights.size(); ++l) {
    if (!before[l]) continue;
    const float scale = shading_.instant.snapshot().light_scale[l];
    plan.blockers.push_back({l, before[l], MostLight(lights[l], scale, box)});
  }
  return plan;
}

void ShadowPlanner::Narrow(const Eigen::AlignedBox3f& box,
                           std::vector<ShadowBlocker>* blockers) const {
  std::erase_if(*blockers, [&](ShadowBlocker& blocker) {
    const AreaLight& light = shading_.world().lights()[blocker.light];
    blocker.movers = MoversIn(Shaft(box, light.center, light.half_u, light.half_v),
                              shading_.instant, blocker.movers);
    return blocker.movers == 0;
  });
}

ShadowPlan ShadowPlanner::Plan(const Tile& tile, std::span<const I8> open,
                               std::span<const float> irradiance) const {
  const StaticPixels pixels(shading_);
  const Eigen::AlignedBox3f box =
      BoxOf(pixels, tile, [&](int x, int y) { return pixels.Lanes(x, y); });
  if (box.isEmpty()) return {};
  ShadowPlan plan = PlanAll(box);
  if (plan.blockers.empty()) return plan;
  const float mean = MeanLight(shading_.image, irradiance, tile);
  DropWeak(mean, &plan.blockers);
  ThinRows(mean, &plan.blockers);
  // Which lights are too weak was asked of all that may be in the way at all; what is traced is
  // what may be in the way of these pixels.
  std::size_t packet = 0;
  Narrow(BoxOf(pixels, tile, [&](int, int) { return open[packet++]; }), &plan.blockers);
  return plan;
}

ShadowPlan ShadowPlanner::Plan(const Eigen::AlignedBox3f& box, float mean_irradiance) const {
  ShadowPlan plan = PlanAll(box);
  DropWeak(mean_irradiance, &plan.blockers);
  Narrow(box, &plan.blockers);
  return plan;
}

}  // namespace aisle::sim
