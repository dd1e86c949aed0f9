#include "simulator/shade/pass/mover_indirect.h"

#include <bit>
#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/pass/emitter_shadows.h"
#include "simulator/shade/pass/mover_blockers.h"

namespace aisle::sim {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kDirections = 16;         // a place
constexpr float kReach = 1.0f;          // m: how far a body darkens itself
constexpr float kReflection = 0.15f;    // what the blocking parts send on in turn
constexpr float kGroundReach = 1.2f;    // m: how far around a body its shadow on the floor is known
constexpr float kGroundSpacing = 0.3f;  // m
constexpr float kDark = 1e-9f;
constexpr float kAboveGround = 0.02f;  // m: lamps see the floor from there

/// Movers that may stand within reach of one.
GeometryMask Around(const Instant& instant, std::size_t mover) {
  const std::span boxes = instant.mover_boxes();
  const Eigen::Vector3f reach = Eigen::Vector3f::Constant(kReach);
  const Eigen::AlignedBox3f box(boxes[mover].min() - reach, boxes[mover].max() + reach);
  GeometryMask mask = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (CastsShadow(instant, i) && box.intersects(boxes[i])) mask |= MoverBit(i);
  }
  return mask;
}

/// Axes around a normal that turn with a vector of the surface, by a further angle.
Eigen::Matrix3f SurfaceBasis(const Eigen::Vector3f& normal, const Eigen::Vector3f& tangent,
                             float angle) {
  const Eigen::Vector3f along = tangent - normal * normal.dot(tangent);
  if (along.squaredNorm() <= 1e-12f * tangent.squaredNorm()) return BasisAround(normal);
  const Eigen::Vector3f x = along.normalized(), y = normal.cross(x);
  Eigen::Matrix3f basis;
  basis.col(0) = std::cos(angle) * x + std::sin(angle) * y;
  basis.col(1) = normal.cross(basis.col(0));
  basis.col(2) = normal;
  return basis;
}

}  // namespace

MoverIndirect::MoverIndirect(const Instant& instant, const Emitters& emitters,
                             const StaticVisibility& statics, const LightVolume& volume,
                             std::size_t mover)
    : instant_(instant),
      volume_(volume),
      bodies_(Around(instant, mover)),
      directions_(CosineDirections(kDirections)),
      ground_z_(
          static_cast<float>(instant.snapshot().movers[mover].T_world_object.translation().z())) {
  const Eigen::AlignedBox3f& box = instant.mover_boxes()[mover];
  const auto node = [](float at) { return static_cast<int>(std::floor(at / kGroundSpacing)); };
  for (int axis = 0; axis < 2; ++axis) {
    first_[axis] = node(box.min()[axis] - kGroundReach);
    nodes_[axis] = node(box.max()[axis] + kGroundReach) + 2 - first_[axis];
  }
  ShadeGround(emitters, statics, mover);
}

void MoverIndirect::ShadeGround(const Emitters& emitters, const StaticVisibility& statics,
                                std::size_t mover) {
  const std::span<const float> scale = instant_.snapshot().light_scale;
  std::vector<ShadowedPlace> places;
  Eigen::AlignedBox3f box;
  for (int y = first_.y(); y < first_.y() + nodes_.y(); ++y) {
    for (int x = first_.x(); x < first_.x() + nodes_.x(); ++x) {
      const Eigen::Vector3f at(kGroundSpacing * static_cast<float>(x),
                               kGroundSpacing * static_cast<float>(y), ground_z_ + kAboveGround);
      places.push_back({{at, Eigen::Vector3f::UnitZ()}, static_cast<std::uint32_t>(x + 73 * y)});
      box.extend(at);
    }
  }
  const EmitterVisibility left = TraceMoverShadowsOn(
      instant_, emitters, PlanEmitterRays(instant_, emitters, box, bodies_), places);
  // The lamps that reach the mover's middle are those that reach the floor around it.
  const std::array<ShadowedPlace, 1> middle = {
      {{{instant_.mover_boxes()[mover].center(), Eigen::Vector3f::UnitZ()}, 0}}};
  EmitterVisibility open(1, emitters.stride());
  statics.Shade(instant_, middle, &open);
  kept_.assign(places.size(), 1);
  ParallelFor(std::size_t{0}, places.size(), [&](std::size_t i) {
    const SurfacePoint& place = places[i].surface;
    F8 all = Wide(0), seen = Wide(0);
    for (std::size_t e = 0; e < emitters.stride(); e += kLanes) {
      const F8 light = emitters.Unshadowed(place, scale, e) * LoadF(&open.Row(0)[e]);
      all += light;
      seen += light * Max(LoadF(&left.Row(i)[e]), Wide(0));
    }
    int blocked = 0;
    for (const unsigned lanes : Probe(place, Eigen::Matrix3f::Identity())) {
      blocked += std::popcount(lanes);
    }
    const float sky = 1 - static_cast<float>(blocked) / kDirections * (1 - kReflection);
    const float indirect = volume_.Irradiance(place.position, place.normal);
    kept_[i] = (Sum(seen) + sky * indirect + kDark) / (Sum(all) + indirect + kDark);
  });
}

MoverIndirect::Blocked MoverIndirect::Probe(const SurfacePoint& point,
                                            const Eigen::Matrix3f& basis) const {
  Blocked blocked;
  Rays8 rays;
  for (std::size_t d = 0; d < directions_.size(); d += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      SetRay(point.position, basis * directions_[d + k], kReach, static_cast<int>(k), &rays);
    }
    blocked.push_back(instant_.Occluded(rays, Coherence::kIncoherent, bodies_));
  }
  return blocked;
}

float MoverIndirect::KeptByGround(const Eigen::Vector3f& from,
                                  const Eigen::Vector3f& direction) const {
  const float height = from.z() - ground_z_;
  if (direction.z() >= -1e-3f || height < 0) return 1;
  const Eigen::Vector3f meets = from - height / direction.z() * direction;
  const Eigen::Vector2f at = meets.head<2>() / kGroundSpacing - first_.cast<float>();
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

float MoverIndirect::KeptAt(const ShadowedPlace& place, const Eigen::Vector3f& tangent) const {
  const SurfacePoint& point = place.surface;
  const LightVolume::Node light = volume_.At(point.position);
  const float irradiance = light.Irradiance(point.normal);
  if (irradiance <= 0) return 1;
  const float angle = 2 * kPi * SpreadPoint(static_cast<int>(place.id % 65536)).x();
  const Eigen::Matrix3f basis = SurfaceBasis(point.normal, tangent, angle);
  const Blocked blocked = Probe(point, basis);
  float lost = 0;
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const Eigen::Vector3f direction = basis * directions_[d];
    const float radiance = std::max(0.0f, light.mean + light.slope.dot(direction));
    const bool is_blocked = blocked[d / kLanes] >> (d % kLanes) & 1;
    lost += is_blocked ? radiance - kReflection * light.mean
                       : radiance * (1 - KeptByGround(point.position, direction));
  }
  const float share = kPi / static_cast<float>(directions_.size());
  return std::clamp(1 - share * lost / irradiance, 0.0f, 1.0f);
}

}  // namespace aisle::sim
