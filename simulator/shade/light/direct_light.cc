#include "simulator/shade/light/direct_light.h"

#include "simulator/common/parallel.h"
#include "simulator/shade/lanes/ray_packets.h"
#include "simulator/shade/light/emitter_rays.h"
#include "simulator/shade/light/form_factor.h"

namespace aisle::sim {
namespace {

constexpr float kLift = 2e-3f;        // m, along the normal
constexpr float kDrawIn = 3e-3f;      // m, towards the triangle's centre
constexpr float kLightGuard = 0.01f;  // m: shadow rays end so far before the light's own surface
constexpr int kLeastRays = 2, kMostRays = 32;  // to one light
constexpr float kFar =
    4;  // extents off, a light is about as bright as if all of it were its centre

/// Up to eight points in lanes, each with places of its own on the lights from `turn` on.
Places8 Load(std::span<const SurfacePoint> points, std::uint32_t turn) {
  std::array<ShadowedPlace, kLanes> places;
  const std::size_t count = std::min(points.size(), places.size());
  for (std::size_t i = 0; i < count; ++i) places[i] = {points[i], turn++};
  return Places8(std::span(places).first(count));
}

/// Light per area and radiance from one place of the light, and the way there.
struct Sample8 {
  F8 dx, dy, dz, distance;
  F8 weight;  ///< cos·cos' / r²
};

class Light {
 public:
  explicit Light(const AreaLight& light)
      : light_(light), near_(kFar * (light.half_u.norm() + light.half_v.norm())) {
    const Eigen::Vector3f cross = light.half_u.cross(light.half_v);
    area_ = 4 * cross.norm();
    normal_ = cross.normalized();
  }
  Sample8 At(const Places8& p, F8 a, F8 b) const {
    const Eigen::Vector3f &c = light_.center, &u = light_.half_u, &v = light_.half_v;
    Sample8 s;
    s.dx = c.x() + a * u.x() + b * v.x() - p.position.x;
    s.dy = c.y() + a * u.y() + b * v.y() - p.position.y;
    s.dz = c.z() + a * u.z() + b * v.z() - p.position.z;
    const F8 squared = Max(s.dx * s.dx + s.dy * s.dy + s.dz * s.dz, Wide(1e-6f));
    s.distance = Sqrt(squared);
    const F8 here = p.normal.x * s.dx + p.normal.y * s.dy + p.normal.z * s.dz;
    const F8 there = -(normal_.x() * s.dx + normal_.y() * s.dy + normal_.z() * s.dz);
    s.weight = Max(here, Wide(0)) * Max(there, Wide(0)) / (squared * squared);
    return s;
  }
  /// What all of it sends were nothing in between. A light that is near, or that the place's
  /// horizon cuts, is not taken for its centre: a sky's may lie behind a facade that much of it
  /// shines on.
  F8 Unshadowed(const Places8& p) const {
    const Sample8 center = At(p, Wide(0), Wide(0));
    F8 light = center.weight * power();
    const I8 exact = (center.distance < near_) | IsCut(p, center);
    for (int k = 0; Any(exact) && k < kLanes; ++k) {
      if (!exact[k]) continue;
      light[k] = UnshadowedIrradiance(light_, {{p.position.x[k], p.position.y[k], p.position.z[k]},
                                               {p.normal.x[k], p.normal.y[k], p.normal.z[k]}});
    }
    return light;
  }
  float power() const { return area_ * light_.radiance; }

 private:
  /// Whether some of it lies above the horizon and some below.
  I8 IsCut(const Places8& p, const Sample8& center) const {
    const auto along = [&](const Eigen::Vector3f& v) {
      return p.normal.x * v.x() + p.normal.y * v.y() + p.normal.z * v.z();
    };
    const F8 u = along(light_.half_u), v = along(light_.half_v);
    const F8 height = p.normal.x * center.dx + p.normal.y * center.dy + p.normal.z * center.dz;
    return Abs(height) < Abs(u) + Abs(v);
  }

  const AreaLight& light_;
  float near_;
  float area_;
  Eigen::Vector3f normal_;
};

Rays8 RaysTo(const Places8& p, const Sample8& s) {
  const F8 t_far = 1 - kLightGuard / Max(s.distance, Wide(2 * kLightGuard));
  return MakeRays(p.position, {s.dx, s.dy, s.dz}, t_far, s.weight > 0);
}

/// The light's irradiance from so many places on it. They differ from point to point: lamps and the
/// beams below them stand in line, and places that all points share would all be hidden, or none,
/// over metres of floor. Nothing is concluded from the first few: where these all see the light,
/// others may well not.
F8 Gather(const Instant& instant, const Light& light, const Places8& p, int rays,
          GeometryMask occluders) {
  constexpr std::size_t kMost = Instant::kMostPackets;
  F8 weights[kMost];
  std::array<Rays8, kMost> packets;
  std::array<unsigned, kMost> blocked;
  std::size_t count = 0;
  F8 irradiance = Wide(0);
  for (int i = 0; i < rays; ++i) {
    const auto [a, b] = p.PlaceOnEmitter(i);
    const Sample8 s = light.At(p, a, b);
    if (Any(s.weight > 0)) {
      weights[count] = s.weight;
      packets[count++] = RaysTo(p, s);
    }
    if (count == 0 || (count < kMost && i + 1 < rays)) continue;
    instant.Occluded(std::span(packets).first(count), Coherence::kCoherent, occluders, blocked);
    for (std::size_t k = 0; k < count; ++k) {
      irradiance += Select(LanesOf(blocked[k]), Wide(0), weights[k]);
    }
    count = 0;
  }
  return irradiance * (light.power() / static_cast<float>(rays));
}

}  // namespace

SurfacePoint LocatePoint(const LightGrid& grid, std::size_t index, const TriangleMesh& topology,
                         std::span<const Eigen::Vector3f> positions,
                         std::span<const Eigen::Vector3f> normals) {
  const LightPoint& point = grid.points[index];
  const auto& [a, b, c] = topology.triangles[point.triangle];
  const float w = 1 - point.u - point.v;
  Eigen::Vector3f position = w * positions[a] + point.u * positions[b] + point.v * positions[c];
  const Eigen::Vector3f inward = (positions[a] + positions[b] + positions[c]) / 3 - position;
  const float length = inward.norm();
  if (length > 0) position += inward * std::min(0.3f, kDrawIn / length);
  const Eigen::Vector3f normal =
      (w * normals[a] + point.u * normals[b] + point.v * normals[c]).normalized();
  return {position + kLift * normal, normal};
}

std::vector<SurfacePoint> LocatePoints(const LightGrid& grid, const TriangleMesh& topology,
                                       std::span<const Eigen::Vector3f> positions,
                                       std::span<const Eigen::Vector3f> normals) {
  std::vector<SurfacePoint> points(grid.points.size());
  ParallelFor(std::size_t{0}, points.size(), [&](std::size_t i) {
    points[i] = LocatePoint(grid, i, topology, positions, normals);
  });
  return points;
}

std::array<float, kLanes> UnshadowedLight(std::span<const AreaLight> lights,
                                          std::span<const float> light_scale,
                                          std::span<const SurfacePoint> points) {
  const Places8 p = Load(points, 0);
  F8 sum = Wide(0);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (light_scale[i] > 0) sum += Light(lights[i]).Unshadowed(p) * light_scale[i];
  }
  std::array<float, kLanes> result;
  Store(sum, result.data());
  return result;
}

std::array<float, kLanes> GatherDirectLight(const Instant& instant,
                                            std::span<const AreaLight> lights,
                                            std::span<const float> light_scale,
                                            std::span<const SurfacePoint> points,
                                            const DirectLightOptions& options) {
  const Places8 p = Load(points, options.turn);
  // Strongest first; lanes of a packet are neighbours, so they share the order.
  std::vector<std::pair<float, std::size_t>> order;
  F8 unshadowed = Wide(0);
  float left = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (light_scale[i] <= 0) continue;
    const F8 light = Light(lights[i]).Unshadowed(p) * light_scale[i];
    const float sum = Sum(light);
    if (sum <= 0) continue;
    unshadowed += light;
    left += sum;
    order.emplace_back(-sum, i);
  }
  std::ranges::sort(order);
  const float all = left, enough = all * options.untraced_share;

  F8 sum = Wide(0), traced = Wide(0);
  for (const auto& [negative, i] : order) {
    if (left <= enough) break;
    left += negative;
    const Light light(lights[i]);
    traced += light.Unshadowed(p) * light_scale[i];
    const auto by_share = static_cast<int>(-negative / all * static_cast<float>(options.rays));
    const int rays = std::clamp(by_share, kLeastRays, kMostRays);
    sum += Gather(instant, light, p, rays, options.occluders) * light_scale[i];
  }
  const F8 grow = Select(traced > 0, unshadowed / Max(traced, Wide(1e-12f)), Wide(1));
  std::array<float, kLanes> result;
  Store(sum * grow, result.data());
  return result;
}

}  // namespace aisle::sim
