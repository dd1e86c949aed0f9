#include "simulator/shade/pass/mover_indirect.h"

#include <algorithm>
#include <bit>
#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/pass/emitter_shadows.h"
#include "simulator/shade/pass/mover_blockers.h"

namespace aisle::sim {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr std::size_t kDirections = 16;  // a place
constexpr float kReach = 1.0f;           // m: how far a body darkens itself
constexpr float kReflection = 0.15f;     // what the blocking parts send on in turn
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
                             std::size_t mover, float floor_z)
    : instant_(instant), volume_(volume), bodies_(Around(instant, mover)), ground_z_(floor_z) {
  const std::vector<Eigen::Vector3f> directions = CosineDirections(kDirections);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    directions_[d / kLanes].x[d % kLanes] = directions[d].x();
    directions_[d / kLanes].y[d % kLanes] = directions[d].y();
    directions_[d / kLanes].z[d % kLanes] = directions[d].z();
  }
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
    for (const I8 lanes : Probe(place, directions_)) blocked += std::popcount(Bits(lanes));
    const float sky =
        1 - static_cast<float>(blocked) / static_cast<float>(kDirections) * (1 - kReflection);
    const float indirect = volume_.Irradiance(place.position, place.normal);
    kept_[i] = (Sum(seen) + sky * indirect + kDark) / (Sum(all) + indirect + kDark);
  });
}

MoverIndirect::Directions MoverIndirect::Turned(const Eigen::Matrix3f& basis) const {
  Directions turned;
  for (std::size_t packet = 0; packet < kPackets; ++packet) {
    const F8x3& d = directions_[packet];
    // The order in which a 3 x 3 matrix of Eigen's sums.
    const auto row = [&](int i) {
      return basis(i, 0) * d.x + (basis(i, 1) * d.y + basis(i, 2) * d.z);
    };
    turned[packet] = {row(0), row(1), row(2)};
  }
  return turned;
}

std::array<I8, MoverIndirect::kPackets> MoverIndirect::Probe(const SurfacePoint& point,
                                                             const Directions& directions) const {
  const Eigen::Vector3f& p = point.position;
  const F8x3 from = {Wide(p.x()), Wide(p.y()), Wide(p.z())};
  std::array<Segments8, kPackets> ways;
  for (std::size_t packet = 0; packet < kPackets; ++packet) {
    ways[packet] = {from, directions[packet], Wide(kReach), WideInt(-1)};
  }
  std::array<unsigned, kPackets> blocked;
  FindBlocked(instant_, bodies_, Coherence::kIncoherent, ways, blocked);
  std::array<I8, kPackets> lanes;
  std::ranges::transform(blocked, lanes.begin(), LanesOf);
  return lanes;
}

F8 MoverIndirect::KeptByGround(const Eigen::Vector3f& from, const F8x3& directions) const {
  const float height = from.z() - ground_z_;
  const I8 down = directions.z < -1e-3f;
  if (height < 0 || !Any(down)) return Wide(1);
  const F8 length = height / Select(down, directions.z, Wide(-1));
  const F8 at_x =
      (from.x() - length * directions.x) / kGroundSpacing - static_cast<float>(first_.x());
  const F8 at_y =
      (from.y() - length * directions.y) / kGroundSpacing - static_cast<float>(first_.y());
  const F8 x = Floor(at_x), y = Floor(at_y);
  const I8 inside = down & (x >= 0) & (y >= 0) & (x + 1 < static_cast<float>(nodes_.x())) &
                    (y + 1 < static_cast<float>(nodes_.y()));
  if (!Any(inside)) return Wide(1);
  const I8 i = inside ? ToInt(y) * nodes_.x() + ToInt(x) : I8{};
  const I8 below = i + nodes_.x();
  const F8 fx = at_x - x, fy = at_y - y;
  const float* kept = kept_.data();
  const F8 mixed = (1 - fy) * ((1 - fx) * Gather(kept, i) + fx * Gather(kept, i + 1)) +
                   fy * ((1 - fx) * Gather(kept, below) + fx * Gather(kept, below + 1));
  return Select(inside, mixed, Wide(1));
}

float MoverIndirect::KeptAt(const ShadowedPlace& place, const Eigen::Vector3f& tangent) const {
  const SurfacePoint& point = place.surface;
  const LightVolume::Node light = volume_.At(point.position);
  const float irradiance = light.Irradiance(point.normal);
  if (irradiance <= 0) return 1;
  const float angle = 2 * kPi * SpreadPoint(static_cast<int>(place.id % 65536)).x();
  const Directions directions = Turned(SurfaceBasis(point.normal, tangent, angle));
  const std::array<I8, kPackets> blocked = Probe(point, directions);
  float lost = 0;
  for (std::size_t packet = 0; packet < kPackets; ++packet) {
    const F8x3& d = directions[packet];
    const F8 radiance =
        Max(Wide(0),
            light.mean + (light.slope.x() * d.x + (light.slope.y() * d.y + light.slope.z() * d.z)));
    const F8 of_blocked = radiance - kReflection * light.mean;
    const F8 of_ground = radiance * (1 - KeptByGround(point.position, d));
    const F8 of_all = Select(blocked[packet], of_blocked, of_ground);
    for (int k = 0; k < kLanes; ++k) lost += of_all[k];
  }
  const float share = kPi / static_cast<float>(kDirections);
  return std::clamp(1 - share * lost / irradiance, 0.0f, 1.0f);
}

}  // namespace aisle::sim
