#include "simulator/truth/moving_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

constexpr float kLift = 2e-3f;     // m off the surface, so that a ray does not meet it
constexpr float kReach = 0.998f;   // of the way to the lamp, so that it does not meet the lamp
constexpr float kSoftest = 1e-4f;  // share of half a window
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

/// Ways from the places towards a light, and what comes along each.
struct Ways {
  std::array<Eigen::Vector3f, kLanes> way;
  std::array<float, kLanes> reach{};  ///< share of it on which something can stand
  std::array<float, kLanes> light{};  ///< irradiance where nothing does
  unsigned lit = 0;                   ///< lanes that have any

  void Set(int lane, const Eigen::Vector3f& to, float share, float irradiance) {
    if (!(irradiance > 0)) return;
    const auto k = static_cast<std::size_t>(lane);
    way[k] = to;
    reach[k] = std::max(0.0f, share);
    light[k] = irradiance;
    lit |= 1u << lane;
  }
};

/// Whether something in the ball can stand between the places and the lamp.
bool CanBlock(const Sphere& mover, const Sphere& from, const Sphere& lamp) {
  const Eigen::Vector3f way = lamp.center - from.center;
  const float share =
      std::clamp((mover.center - from.center).dot(way) / way.squaredNorm(), 0.0f, 1.0f);
  const float reach = mover.radius + std::max(from.radius, lamp.radius);
  return (mover.center - from.center - share * way).squaredNorm() < reach * reach;
}

/// Rays along the ways of the lanes in `wanted`.
Rays8 RaysAlong(const Ways& ways, const Places& places, unsigned wanted) {
  Rays8 rays;
  for (int k = 0; k < kLanes; ++k) {
    const auto lane = static_cast<std::size_t>(k);
    const bool valid = wanted >> k & 1;
    const Eigen::Vector3f from = valid ? places.position[lane] : Eigen::Vector3f::Zero();
    const Eigen::Vector3f to = valid ? ways.way[lane] : Eigen::Vector3f::UnitZ();
    rays.valid[k] = valid ? -1 : 0;
    rays.ox[k] = from.x(), rays.oy[k] = from.y(), rays.oz[k] = from.z();
    rays.dx[k] = to.x(), rays.dy[k] = to.y(), rays.dz[k] = to.z();
    rays.t_near[k] = 0;
    rays.t_far[k] = ways.reach[lane];
  }
  return rays;
}

/// Share of a row of panes that is open within `soft` of `along`, where the row is [-1, 1].
float OpenShare(double along, double soft, int panes, double bar) {
  const double per_pane = 2.0 / panes, open = std::max(0.0, 1 - bar);
  const auto open_until = [&](double to) {
    const double bays = std::clamp((to + 1) / per_pane, 0.0, 1.0 * panes);
    const double whole = std::floor(bays);
    return whole * open + std::clamp(bays - whole - bar / 2, 0.0, open);
  };
  return static_cast<float>((open_until(along + soft) - open_until(along - soft)) * per_pane /
                            (2 * soft));
}

void SetSpot(const Beam& beam, const Places& places, int lane, Ways* ways) {
  const auto k = static_cast<std::size_t>(lane);
  const Eigen::Vector3f to = beam.origin - places.position[k];
  const float distance = std::max(to.norm(), Beam::kHousing_m);
  const float along = -to.dot(beam.toward) / distance;
  const float t = std::clamp(
      (along - beam.cos_outer) / std::max(beam.cos_inner - beam.cos_outer, 1e-5f), 0.0f, 1.0f);
  const float edge = t * t * (3 - 2 * t);
  ways->Set(lane, to, 1 - Beam::kHousing_m / distance,
            beam.power * edge * to.dot(places.normal[k]) / (distance * distance * distance));
}

void SetSun(const Beam& beam, const Places& places, int lane, Ways* ways) {
  const auto k = static_cast<std::size_t>(lane);
  const Eigen::Vector3f plane = beam.half_u.cross(beam.half_v).normalized();
  const float across = plane.dot(beam.toward);
  if (std::abs(across) < 1e-4f) return;
  const Eigen::Vector3f to = beam.origin - places.position[k];
  const float distance = to.dot(plane) / across;
  if (!(distance > 0)) return;
  const Eigen::Vector3f meets = distance * beam.toward - to;  // from the window's middle
  const auto open = [&](const Eigen::Vector3f& half, int panes, float bar) {
    const float length = half.norm();
    const float soft = std::max(distance * Beam::kSunRadius / length, kSoftest);
    return OpenShare(meets.dot(half) / (length * length), soft, panes, bar);
  };
  ways->Set(lane, distance * beam.toward, 1 - Beam::kBeforeWindow_m / distance,
            beam.power * open(beam.half_u, beam.columns, beam.bar_u) *
                open(beam.half_v, beam.rows, beam.bar_v) * beam.toward.dot(places.normal[k]));
}

class ShadowFinder {
 public:
  ShadowFinder(const World& world, const Instant& instant, const MovingNow& moving,
               const MovingShadowOptions& options)
      : world_(world), instant_(instant), moving_(moving), options_(options) {
    for (std::size_t m = 0; m < instant.mover_boxes().size(); ++m) {
      const Eigen::AlignedBox3f& box = instant.mover_boxes()[m];
      balls_.push_back({box.center(), box.diagonal().norm() / 2});
      if (!instant.snapshot().movers[m].casts_shadow) continue;
      (moving.Any(m) ? stirring_ : resting_) |= MoverBit(m);
    }
  }

  bool AnythingMoves() const { return stirring_ != 0; }

  /// Bits of the places that lie in a moving shadow.
  unsigned Find(const Places& places) const {
    const PerLane lost = Lost(places);
    unsigned touched = 0;
    for (int k = 0; k < kLanes; ++k) {
      if (lost[static_cast<std::size_t>(k)] > 0) touched |= 1u << k;
    }
    if (!touched) return 0;
    const auto lose_much = [&](const PerLane& light, unsigned lanes) {
      unsigned lose = 0;
      for (int k = 0; k < kLanes; ++k) {
        const auto lane = static_cast<std::size_t>(k);
        if (lanes >> k & 1 && lost[lane] > options_.share * light[lane]) lose |= 1u << k;
      }
      return lose;
    };
    // Who loses much even of what would come if nothing stood anywhere is spared the rays.
    const unsigned sure = lose_much(LightOfAll(places, touched), touched);
    const unsigned doubtful = touched & ~sure;
    return doubtful ? sure | lose_much(LightPastWhatRests(places, lost, doubtful), doubtful) : sure;
  }

 private:
  using PerLane = std::array<float, kLanes>;

  /// Light that what moves keeps away, and nothing that rests would.
  PerLane Lost(const Places& places) const {
    PerLane lost{};
    ForEachLight(places, [&](const Sphere& lamp, const auto& each_way) {
      const GeometryMask stirring = Between(places, lamp, stirring_);
      if (!stirring) return;
      const GeometryMask rests = kStaticOnly | Between(places, lamp, resting_);
      each_way(places.valid, [&](const Ways& ways) {
        unsigned lanes = Blocked(ways, places, stirring, ways.lit);
        lanes &= ~Blocked(ways, places, rests, lanes);
        const Met met = Meet(ways, places, stirring, lanes);
        Add(ways, met.moving & ~met.resting, &lost);
      });
    });
    return lost;
  }

  /// Light where there is nothing else.
  PerLane LightOfAll(const Places& places, unsigned wanted) const {
    PerLane sum{};
    ForEachLight(places, [&](const Sphere&, const auto& each_way) {
      each_way(wanted, [&](const Ways& ways) { Add(ways, ways.lit, &sum); });
    });
    return sum;
  }

  /// Light where there is nothing that moves: what arrives as it is, and what is lost.
  PerLane LightPastWhatRests(const Places& places, const PerLane& lost, unsigned wanted) const {
    PerLane sum = lost;
    ForEachLight(places, [&](const Sphere& lamp, const auto& each_way) {
      const GeometryMask any = kStaticOnly | Between(places, lamp, resting_ | stirring_);
      each_way(wanted, [&](const Ways& ways) {
        Add(ways, ways.lit & ~Blocked(ways, places, any, ways.lit), &sum);
      });
    });
    return sum;
  }

  static void Add(const Ways& ways, unsigned lanes, PerLane* sum) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (lanes >> k & 1) (*sum)[k] += ways.light[k];
    }
  }

  /// Those of the movers that may stand between the places and a lamp.
  GeometryMask Between(const Places& places, const Sphere& lamp, GeometryMask movers) const {
    GeometryMask mask = 0;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      if ((movers & MoverBit(i)) && CanBlock(balls_[i], places.bound, lamp)) mask |= MoverBit(i);
    }
    return mask;
  }

  /// Calls use(ball around the light, each_way) for each light that shines; each_way(lanes, use)
  /// calls use(ways) for each of its points.
  template <typename Use>
  void ForEachLight(const Places& places, const Use& use) const {
    for (std::size_t i = 0; i < world_.lights().size(); ++i) {
      if (instant_.snapshot().light_scale[i] <= 0) continue;
      const AreaLight& lamp = world_.lights()[i];
      use(Sphere{lamp.center, (lamp.half_u + lamp.half_v).norm()},
          [&](unsigned lanes, const auto& use_ways) {
            for (const auto& [a, b] : kSamples) {
              const Eigen::Vector3f target = lamp.center + a * lamp.half_u + b * lamp.half_v;
              UseLit(lanes, use_ways,
                     [&](int lane, Ways* ways) { SetLamp(i, target, places, lane, ways); });
            }
          });
    }
    for (const Beam& beam : instant_.snapshot().beams) {
      const bool is_spot = beam.kind == Beam::Kind::kSpot;
      use(Sphere{beam.origin, is_spot ? 0.0f : (beam.half_u + beam.half_v).norm()},
          [&](unsigned lanes, const auto& use_ways) {
            UseLit(lanes, use_ways, [&](int lane, Ways* ways) {
              is_spot ? SetSpot(beam, places, lane, ways) : SetSun(beam, places, lane, ways);
            });
          });
    }
  }

  template <typename Use, typename SetWay>
  static void UseLit(unsigned lanes, const Use& use, const SetWay& set) {
    Ways ways;
    for (int k = 0; k < kLanes; ++k) {
      if (lanes >> k & 1) set(k, &ways);
    }
    if (ways.lit) use(ways);
  }

  /// Of a luminaire's quarter around `target`.
  void SetLamp(std::size_t light, const Eigen::Vector3f& target, const Places& places, int lane,
               Ways* ways) const {
    const AreaLight& lamp = world_.lights()[light];
    const auto k = static_cast<std::size_t>(lane);
    const Eigen::Vector3f way = target - places.position[k];
    const float square = way.squaredNorm();
    const Eigen::Vector3f quarter = lamp.half_u.cross(lamp.half_v);
    ways->Set(lane, way, kReach,
              instant_.snapshot().light_scale[light] * lamp.radiance *
                  std::max(0.0f, places.normal[k].dot(way)) * std::max(0.0f, -quarter.dot(way)) /
                  (square * square));
  }

  /// Lanes of `wanted` whose ways something of these blocks.
  unsigned Blocked(const Ways& ways, const Places& places, GeometryMask geometries,
                   unsigned wanted) const {
    if (!wanted || !geometries) return 0;
    return wanted &
           instant_.Occluded(RaysAlong(ways, places, wanted), Coherence::kCoherent, geometries);
  }

  /// What of movers that stir lanes meet on their ways: surfaces that move now, or one that rests,
  /// beyond which nobody looks.
  struct Met {
    unsigned moving = 0, resting = 0;
  };
  Met Meet(const Ways& ways, const Places& places, GeometryMask movers, unsigned wanted) const {
    Met met;
    Rays8 rays = RaysAlong(ways, places, wanted);
    while (wanted) {
      Hits8 hits;
      instant_.Intersect(rays, Coherence::kCoherent, movers, &hits);
      for (int k = 0; k < kLanes; ++k) {
        if (!(wanted >> k & 1)) continue;
        bool goes_on = false;
        if (hits.geometry[k] != kNoGeometry) {
          goes_on = moving_(hits.geometry[k] - 1, hits.primitive[k], hits.u[k], hits.v[k]);
          (goes_on ? met.moving : met.resting) |= 1u << k;
          rays.t_near[k] = hits.t[k] + kLift / ways.way[static_cast<std::size_t>(k)].norm();
        }
        if (goes_on && rays.t_near[k] < rays.t_far[k]) continue;
        rays.valid[k] = 0;
        wanted &= ~(1u << k);
      }
    }
    return met;
  }

  const World& world_;
  const Instant& instant_;
  const MovingNow& moving_;
  const MovingShadowOptions options_;
  std::vector<Sphere> balls_;  ///< around each mover
  /// Movers that keep light away: of which something moves now, and of which nothing does.
  GeometryMask stirring_ = 0, resting_ = 0;
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
