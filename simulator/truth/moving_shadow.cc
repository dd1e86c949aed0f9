#include "simulator/truth/moving_shadow.h"

#include <algorithm>
#include <array>
#include <vector>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

constexpr float kLift = 2e-3f;    // m off the surface, so that a ray does not meet it
constexpr float kReach = 0.998f;  // of the way to the lamp, so that it does not meet the lamp
constexpr std::array<std::array<float, 2>, 4> kSamples = {
    {{-0.5f, -0.5f}, {0.5f, -0.5f}, {-0.5f, 0.5f}, {0.5f, 0.5f}}};

struct Sphere {
  Eigen::Vector3f center;
  float radius;
};

/// Eight neighbouring pixels of a row that may lie in a shadow.
struct Places {
  std::array<Eigen::Vector3f, kLanes> position, normal;
  unsigned valid = 0;
  Sphere bound{Eigen::Vector3f::Zero(), 0};
};

Eigen::Vector3f NormalOf(const World& world, const Snapshot& snapshot, const HitImage& hits,
                         std::size_t i) {
  const std::uint32_t geometry = hits.geometry[i];
  const TriangleMesh& mesh =
      geometry == 0 ? world.statics().mesh : world.mover_meshes()[geometry - 1];
  const std::vector<Eigen::Vector3f>& positions =
      geometry == 0 ? mesh.positions : snapshot.movers[geometry - 1].positions;
  const auto& [a, b, c] = mesh.triangles[hits.primitive[i]];
  return (positions[b] - positions[a]).cross(positions[c] - positions[a]).normalized();
}

Places FindPlaces(const World& world, const Instant& instant, const CameraView& view,
                  const HitImage& hits, const MovingNow& moving, int x0, int y) {
  Places places;
  Eigen::AlignedBox3f box;
  for (int k = 0; k < kLanes && x0 + k < hits.width; ++k) {
    const std::size_t i = hits.Index(x0 + k, y);
    const std::uint32_t geometry = hits.geometry[i];
    if (geometry == kNoGeometry) continue;
    if (geometry != 0 && moving(geometry - 1, hits.primitive[i], hits.u[i], hits.v[i])) continue;
    const auto lane = static_cast<std::size_t>(k);
    const Eigen::Vector3f direction = view.rotation * view.rays->At(x0 + k, y).homogeneous();
    Eigen::Vector3f normal = NormalOf(world, instant.snapshot(), hits, i);
    if (normal.dot(direction) > 0) normal = -normal;  // the side that is seen
    places.normal[lane] = normal;
    places.position[lane] = view.origin + hits.t[i] * direction + kLift * normal;
    places.valid |= 1u << k;
    box.extend(places.position[lane]);
  }
  if (places.valid) places.bound = {box.center(), box.diagonal().norm() / 2};
  return places;
}

/// Whether something in the ball can stand between the places and the lamp.
bool CanBlock(const Sphere& mover, const Sphere& from, const Sphere& lamp) {
  const Eigen::Vector3f way = lamp.center - from.center;
  const float share =
      std::clamp((mover.center - from.center).dot(way) / way.squaredNorm(), 0.0f, 1.0f);
  const float reach = mover.radius + std::max(from.radius, lamp.radius);
  return (mover.center - from.center - share * way).squaredNorm() < reach * reach;
}

/// Rays from the lanes in `wanted` to a point of a lamp.
Rays8 RaysTo(const Eigen::Vector3f& target, const Places& places, unsigned wanted) {
  Rays8 rays;
  for (int k = 0; k < kLanes; ++k) {
    rays.valid[k] = wanted >> k & 1 ? -1 : 0;
    const Eigen::Vector3f from =
        rays.valid[k] ? places.position[static_cast<std::size_t>(k)] : target;
    const Eigen::Vector3f to =
        rays.valid[k] ? Eigen::Vector3f(target - from) : Eigen::Vector3f(Eigen::Vector3f::UnitZ());
    rays.ox[k] = from.x(), rays.oy[k] = from.y(), rays.oz[k] = from.z();
    rays.dx[k] = to.x(), rays.dy[k] = to.y(), rays.dz[k] = to.z();
    rays.t_near[k] = 0;
    rays.t_far[k] = kReach;
  }
  return rays;
}

class ShadowFinder {
 public:
  ShadowFinder(const World& world, const Instant& instant, const MovingNow& moving,
               const MovingShadowOptions& options)
      : world_(world), instant_(instant), moving_(moving), options_(options) {
    for (std::size_t m = 0; m < instant.mover_boxes().size(); ++m) {
      const Eigen::AlignedBox3f& box = instant.mover_boxes()[m];
      balls_.push_back({box.center(), box.diagonal().norm() / 2});
      casts_.push_back(instant.snapshot().movers[m].casts_shadow && moving.Any(m));
      anything_moves_ |= casts_.back();
    }
  }

  bool AnythingMoves() const { return anything_moves_; }

  /// Bits of the places that lie in a moving shadow.
  unsigned Find(const Places& places) const {
    std::array<float, kLanes> lost{};
    for (std::size_t i = 0; i < world_.lights().size(); ++i) {
      const GeometryMask movers = BlockersOf(i, places);
      if (movers) AddLost(i, places, movers, &lost);
    }
    unsigned touched = 0;
    for (int k = 0; k < kLanes; ++k) {
      if (lost[static_cast<std::size_t>(k)] > 0) touched |= 1u << k;
    }
    if (!touched) return 0;
    const std::array<float, kLanes> all = LightThroughTheStaticWorld(places, touched);
    unsigned shadowed = 0;
    for (int k = 0; k < kLanes; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      if (touched >> k & 1 && lost[lane] > options_.share * all[lane]) shadowed |= 1u << k;
    }
    return shadowed;
  }

 private:
  float ScaleOf(std::size_t light) const { return instant_.snapshot().light_scale[light]; }

  GeometryMask BlockersOf(std::size_t light, const Places& places) const {
    if (ScaleOf(light) <= 0) return 0;
    const AreaLight& lamp = world_.lights()[light];
    const Sphere ball{lamp.center, (lamp.half_u + lamp.half_v).norm()};
    GeometryMask mask = 0;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      if (casts_[i] && CanBlock(balls_[i], places.bound, ball)) mask |= MoverBit(i);
    }
    return mask;
  }

  /// Irradiance from a sample of a lamp that nothing blocks, up to a common factor.
  float Unblocked(std::size_t light, const Eigen::Vector3f& target, const Places& places,
                  int lane) const {
    const AreaLight& lamp = world_.lights()[light];
    const auto k = static_cast<std::size_t>(lane);
    const Eigen::Vector3f way = target - places.position[k];
    const float square = way.squaredNorm();
    const Eigen::Vector3f area = lamp.half_u.cross(lamp.half_v);
    return ScaleOf(light) * lamp.radiance * std::max(0.0f, places.normal[k].dot(way)) *
           std::max(0.0f, -area.dot(way)) / (square * square);
  }

  template <typename Use>
  void ForEachSample(std::size_t light, const Places& places, unsigned wanted, Use use) const {
    const AreaLight& lamp = world_.lights()[light];
    for (const auto& [a, b] : kSamples) {
      const Eigen::Vector3f target = lamp.center + a * lamp.half_u + b * lamp.half_v;
      std::array<float, kLanes> light_of{};
      unsigned lit = 0;
      for (int k = 0; k < kLanes; ++k) {
        if (!(wanted >> k & 1)) continue;
        light_of[static_cast<std::size_t>(k)] = Unblocked(light, target, places, k);
        if (light_of[static_cast<std::size_t>(k)] > 0) lit |= 1u << k;
      }
      if (lit) use(target, lit, light_of);
    }
  }

  void AddLost(std::size_t light, const Places& places, GeometryMask movers,
               std::array<float, kLanes>* lost) const {
    ForEachSample(light, places, places.valid,
                  [&](const Eigen::Vector3f& target, unsigned lit, const auto& light_of) {
                    unsigned blocked = MovingBlockers(target, places, movers, lit);
                    if (!blocked) return;
                    blocked &= ~instant_.Occluded(RaysTo(target, places, blocked),
                                                  Coherence::kCoherent, kStaticOnly);
                    for (std::size_t k = 0; k < kLanes; ++k) {
                      if (blocked >> k & 1) (*lost)[k] += light_of[k];
                    }
                  });
  }

  /// Lanes whose way to the target meets a surface of these movers that moves now.
  unsigned MovingBlockers(const Eigen::Vector3f& target, const Places& places, GeometryMask movers,
                          unsigned lit) const {
    Hits8 hits;
    instant_.Intersect(RaysTo(target, places, lit), Coherence::kCoherent, movers, &hits);
    unsigned moving = 0;
    for (int k = 0; k < kLanes; ++k) {
      if (!(lit >> k & 1) || hits.geometry[k] == kNoGeometry) continue;
      if (moving_(hits.geometry[k] - 1, hits.primitive[k], hits.u[k], hits.v[k])) {
        moving |= 1u << k;
      }
    }
    return moving;
  }

  std::array<float, kLanes> LightThroughTheStaticWorld(const Places& places,
                                                       unsigned wanted) const {
    std::array<float, kLanes> sum{};
    for (std::size_t i = 0; i < world_.lights().size(); ++i) {
      if (ScaleOf(i) <= 0) continue;
      ForEachSample(i, places, wanted,
                    [&](const Eigen::Vector3f& target, unsigned lit, const auto& light_of) {
                      const unsigned open =
                          lit & ~instant_.Occluded(RaysTo(target, places, lit),
                                                   Coherence::kCoherent, kStaticOnly);
                      for (std::size_t k = 0; k < kLanes; ++k) {
                        if (open >> k & 1) sum[k] += light_of[k];
                      }
                    });
    }
    return sum;
  }

  const World& world_;
  const Instant& instant_;
  const MovingNow& moving_;
  const MovingShadowOptions options_;
  std::vector<Sphere> balls_;  ///< around each mover
  std::vector<bool> casts_;    ///< whether it moves and keeps light away
  bool anything_moves_ = false;
};

}  // namespace

cv::Mat1b FindMovingShadows(const World& world, const Instant& instant, const CameraView& view,
                            const HitImage& hits, const MovingNow& moving,
                            const MovingShadowOptions& options) {
  cv::Mat1b mask(hits.height, hits.width, std::uint8_t{0});
  const ShadowFinder finder(world, instant, moving, options);
  if (!finder.AnythingMoves()) return mask;
  ParallelFor(0, hits.height, [&](int y) {
    for (int x = 0; x < hits.width; x += kLanes) {
      const Places places = FindPlaces(world, instant, view, hits, moving, x, y);
      if (!places.valid) continue;
      const unsigned shadowed = finder.Find(places);
      for (int k = 0; k < kLanes && x + k < hits.width; ++k) {
        if (shadowed >> k & 1) mask(y, x + k) = 255;
      }
    }
  });
  return mask;
}

}  // namespace aisle::sim
