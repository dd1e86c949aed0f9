#include "simulator/shade/mover_indirect.h"

#include <tbb/parallel_for.h>

#include <numbers>

#include "simulator/shade/hemisphere.h"

namespace aisle::sim {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kReach = 1.0f;          // m: how far a body darkens itself
constexpr float kReflection = 0.15f;    // what the blocking parts send on in turn
constexpr float kGroundReach = 1.2f;    // m: how far around a body its shadow on the floor is known
constexpr float kGroundSpacing = 0.3f;  // m
constexpr int kGroundLightRays = 16, kGroundHallRays = 8, kGroundBodyRays = 8;
constexpr GeometryMask kNothing = 0;
constexpr float kDark = 1e-9f;
constexpr float kAboveGround = 0.02f;  // m: lamps see the floor from there

/// Movers that may stand within reach of one.
GeometryMask Around(const Instant& instant, std::size_t mover) {
  const std::span boxes = instant.mover_boxes();
  const Eigen::Vector3f reach = Eigen::Vector3f::Constant(kReach);
  const Eigen::AlignedBox3f box(boxes[mover].min() - reach, boxes[mover].max() + reach);
  GeometryMask mask = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (box.intersects(boxes[i])) mask |= MoverBit(i);
  }
  return mask;
}

}  // namespace

MoverIndirect::MoverIndirect(const Instant& instant, std::span<const AreaLight> lights,
                             const LightVolume& volume, std::size_t mover, int directions)
    : instant_(instant),
      volume_(volume),
      bodies_(Around(instant, mover)),
      directions_(CosineDirections(directions)) {
  const Eigen::AlignedBox3f& box = instant.mover_boxes()[mover];
  ground_ = box.min() - Eigen::Vector3f::Constant(kGroundReach);
  ground_.z() =
      static_cast<float>(instant.snapshot().movers[mover].T_world_object.translation().z());
  nodes_ = ((box.sizes().head<2>().array() + 2 * kGroundReach) / kGroundSpacing)
               .ceil()
               .cast<int>()
               .matrix() +
           Eigen::Vector2i::Ones();
  ShadeGround(lights);
}

void MoverIndirect::ShadeGround(std::span<const AreaLight> lights) {
  const auto count = static_cast<std::size_t>(nodes_.prod());
  const std::vector<Eigen::Vector3f> directions = CosineDirections(kGroundBodyRays);
  const std::span<const float> scale = instant_.snapshot().light_scale;
  kept_.assign(count, 1);
  std::vector<SurfacePoint> places;
  for (std::size_t i = 0; i < count; ++i) {
    const int x = static_cast<int>(i) % nodes_.x(), y = static_cast<int>(i) / nodes_.x();
    const Eigen::Vector3f shift(static_cast<float>(x), static_cast<float>(y), 0);
    places.push_back({ground_ + kGroundSpacing * shift + kAboveGround * Eigen::Vector3f::UnitZ(),
                      Eigen::Vector3f::UnitZ()});
  }
  tbb::parallel_for(std::size_t{0}, (count + kLanes - 1) / kLanes, [&](std::size_t packet) {
    const std::size_t first = packet * kLanes;
    const std::span eight =
        std::span(places).subspan(first, std::min<std::size_t>(kLanes, count - first));
    const auto sample = [&](int samples, GeometryMask occluders) {
      return SampleDirectLight(
          instant_, lights, scale, eight,
          {.samples = samples, .turn = static_cast<std::uint32_t>(packet), .occluders = occluders});
    };
    // How much bodies take of the lamps, and how much the lamps give at all, are asked apart: the
    // first, which must be exact, needs no ray through the hall.
    const auto open = sample(kGroundLightRays, kNothing);
    const auto left = sample(kGroundLightRays, bodies_);
    const auto direct = sample(kGroundHallRays, kStaticOnly);
    for (std::size_t k = 0; k < eight.size(); ++k) {
      int blocked = 0;
      for (const unsigned lanes : Probe(eight[k], Eigen::Matrix3f::Identity(), directions)) {
        blocked += std::popcount(lanes);
      }
      const float sky = 1 - static_cast<float>(blocked) / kGroundBodyRays * (1 - kReflection);
      const float indirect = volume_.Irradiance(eight[k].position, eight[k].normal);
      const float kept_direct = open[k] > 0 ? left[k] / open[k] : 1.0f;
      kept_[first + k] =
          (kept_direct * direct[k] + sky * indirect + kDark) / (direct[k] + indirect + kDark);
    }
  });
}

MoverIndirect::Blocked MoverIndirect::Probe(const SurfacePoint& point, const Eigen::Matrix3f& basis,
                                            std::span<const Eigen::Vector3f> directions) const {
  Blocked blocked;
  Rays8 rays;
  for (std::size_t d = 0; d < directions.size(); d += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      SetRay(point.position, basis * directions[d + k], kReach, static_cast<int>(k), &rays);
    }
    blocked.push_back(instant_.Occluded(rays, Coherence::kIncoherent, bodies_));
  }
  return blocked;
}

float MoverIndirect::KeptByGround(const Eigen::Vector3f& from,
                                  const Eigen::Vector3f& direction) const {
  const float height = from.z() - ground_.z();
  if (direction.z() >= -1e-3f || height < 0) return 1;
  const Eigen::Vector3f at = (from - height / direction.z() * direction - ground_) / kGroundSpacing;
  const float x = std::floor(at.x()), y = std::floor(at.y());
  if (!(x >= 0 && y >= 0 && x + 1 < static_cast<float>(nodes_.x()) &&
        y + 1 < static_cast<float>(nodes_.y()))) {
    return 1;
  }
  const float fx = at.x() - x, fy = at.y() - y;
  const auto i = static_cast<std::size_t>(static_cast<int>(y) * nodes_.x() + static_cast<int>(x));
  const std::size_t below = i + static_cast<std::size_t>(nodes_.x());
  return (1 - fy) * ((1 - fx) * kept_[i] + fx * kept_[i + 1]) +
         fy * ((1 - fx) * kept_[below] + fx * kept_[below + 1]);
}

float MoverIndirect::At(const SurfacePoint& point) const {
  const LightVolume::Node light = volume_.At(point.position);
  const Eigen::Matrix3f basis = BasisAround(point.normal);
  const Blocked blocked = Probe(point, basis, directions_);
  float lost = 0;
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const Eigen::Vector3f direction = basis * directions_[d];
    const float radiance = std::max(0.0f, light.mean + light.slope.dot(direction));
    const bool is_blocked = blocked[d / kLanes] >> (d % kLanes) & 1;
    lost += is_blocked ? radiance - kReflection * light.mean
                       : radiance * (1 - KeptByGround(point.position, direction));
  }
  const float share = kPi / static_cast<float>(directions_.size());
  return std::max(0.0f, light.Irradiance(point.normal) - share * lost);
}

}  // namespace aisle::sim
