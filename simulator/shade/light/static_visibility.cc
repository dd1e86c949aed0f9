#include "simulator/shade/light/static_visibility.h"

#include <algorithm>
#include <cmath>

#include "simulator/common/mix.h"
#include "simulator/common/parallel.h"
#include "simulator/shade/lanes/ray_packets.h"
#include "simulator/shade/light/emitter_rays.h"

namespace aisle::sim {
namespace {

constexpr int kProbes = 16;          // rays that ask whether a node lies inside something
constexpr float kBackFaces = 0.25f;  // it does if more than this share of them meet back faces
constexpr int kAxisBits = 21;
constexpr std::int64_t kAxisZero = std::int64_t{1} << (kAxisBits - 1);
constexpr std::uint64_t kAxisMask = (std::uint64_t{1} << kAxisBits) - 1;

std::uint64_t KeyOf(const Eigen::Vector3i& cell) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    key = key << kAxisBits | (static_cast<std::uint64_t>(cell[axis] + kAxisZero) & kAxisMask);
  }
  return key;
}

Eigen::Vector3i CellOf(std::uint64_t key) {
  Eigen::Vector3i cell;
  for (int axis = 2; axis >= 0; --axis, key >>= kAxisBits) {
    cell[axis] = static_cast<int>(static_cast<std::int64_t>(key & kAxisMask) - kAxisZero);
  }
  return cell;
}

/// The cell of eight nodes around a position: its lowest corner, and what each corner counts.
struct Cell {
  std::uint64_t low;
  std::array<float, 8> weights;
};

Cell CellAround(const Eigen::Vector3f& position, float spacing) {
  const Eigen::Vector3f at = (position / spacing).array() - 0.5f;
  const Eigen::Vector3f low = at.array().floor(), f = at - low;
  Cell cell{.low = KeyOf(low.cast<int>()), .weights = {}};
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i step(corner & 1, corner >> 1 & 1, corner >> 2);
    float weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] ? f[axis] : 1 - f[axis];
    cell.weights[static_cast<std::size_t>(corner)] = weight;
  }
  return cell;
}

std::uint64_t CornerOf(std::uint64_t low, int corner) {
  return KeyOf(CellOf(low) + Eigen::Vector3i(corner & 1, corner >> 1 & 1, corner >> 2));
}

}  // namespace

StaticVisibility::StaticVisibility(const Emitters& emitters, const TriangleMesh& topology,
                                   const StaticVisibilityOptions& options)
    : emitters_(emitters), topology_(topology), options_(options) {
  std::size_t lights = 0;
  for (std::size_t i = 0; i < emitters.size(); ++i)
    lights = std::max(lights, emitters[i].light + 1);
  all_on_.assign(lights, 1.0f);
}

Eigen::Vector3f StaticVisibility::PositionOf(Key key) const {
  // Half a cell off the whole metres, where floors and walls lie.
  return options_.spacing_m * (CellOf(key).cast<float>().array() + 0.5f).matrix();
}

bool StaticVisibility::InsideSomething(const Instant& instant,
                                       const Eigen::Vector3f& position) const {
  static const std::vector<Eigen::Vector3f> kDirections = SphereDirections(kProbes);
  int backs = 0;
  Rays8 rays;
  Hits8 hits;
  for (std::size_t d = 0; d < kProbes; d += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      SetRay(position, kDirections[d + k], kInfinity, static_cast<int>(k), &rays);
    }
    instant.Intersect(rays, Coherence::kIncoherent, kStaticOnly, &hits);
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (hits.geometry[k] != 0) continue;
      const auto& [a, b, c] = topology_.triangles[hits.primitive[k]];
      const Eigen::Vector3f& corner = topology_.positions[a];
      const Eigen::Vector3f normal =
          (topology_.positions[b] - corner).cross(topology_.positions[c] - corner);
      backs += normal.dot(kDirections[d + k]) > 0;
    }
  }
  return static_cast<float>(backs) > kBackFaces * kProbes;
}

StaticVisibility::Node StaticVisibility::Trace(const Instant& instant, Key key) const {
  const Eigen::Vector3f position = PositionOf(key);
  Node node{.is_free = !InsideSomething(instant, position),
            .seen = std::vector<std::uint8_t>(emitters_.stride())};
  if (!node.is_free) return node;
  const std::vector<float> shares = emitters_.Shares(position, all_on_);
  // Each node asks for points of its own: lamps and the beams below them stand in line, and points
  // that all nodes share are hidden together, or none of them, over metres.
  const std::array<ShadowedPlace, 1> place = {
      {{{position, Eigen::Vector3f::UnitZ()}, static_cast<std::uint32_t>(Mix(key))}}};
  const Places8 own{std::span<const ShadowedPlace>(place)};
  const F8x3 from = {Wide(position.x()), Wide(position.y()), Wide(position.z())};
  // Eight rays of one place share a packet; where they end on an emitter, all emitters share.
  std::vector<std::pair<F8, F8>> ends;
  for (std::size_t e = 0; e < emitters_.size(); ++e) {
    const Emitters::Emitter& emitter = emitters_[e];
    if ((position - emitter.center).dot(emitter.normal) <= 0) continue;
    const int rays =
        RaysForShare(shares[e], options_.rays_per_share, options_.least_rays, options_.most_rays);
    int seen = 0;
    for (int first = 0; first < rays; first += kLanes) {
      const auto packet = static_cast<std::size_t>(first / kLanes);
      if (packet == ends.size()) ends.push_back(EightOnEmitter(own, first));
      const I8 valid = LanesOf(rays - first < kLanes ? (1u << (rays - first)) - 1 : 255u);
      const F8x3 to = Minus(PointsOn(emitter, ends[packet]), from);
      const unsigned blocked = instant.Occluded(MakeRays(from, to, Wide(kAlmostAtEmitter), valid),
                                                Coherence::kCoherent, kStaticOnly);
      seen += std::popcount(Bits(valid) & ~blocked);
    }
    node.seen[e] = static_cast<std::uint8_t>((255 * seen + rays / 2) / rays);
  }
  return node;
}

std::vector<StaticVisibility::NodePtr> StaticVisibility::NodesOf(const Instant& instant,
                                                                 std::span<const Key> keys) const {
  std::vector<NodePtr> nodes(keys.size());
  std::vector<std::size_t> missing;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (const auto found = nodes_.find(keys[i]); found != nodes_.end()) {
        nodes[i] = found->second;
      } else {
        missing.push_back(i);
      }
    }
  }
  if (missing.empty()) return nodes;
  ParallelFor(std::size_t{0}, missing.size(), [&](std::size_t i) {
    nodes[missing[i]] = std::make_shared<const Node>(Trace(instant, keys[missing[i]]));
  });
  const std::lock_guard lock(mutex_);
  if (nodes_.size() + missing.size() > options_.most_nodes) nodes_.clear();
  for (const std::size_t i : missing) nodes_.try_emplace(keys[i], nodes[i]);
  return nodes;
}

std::vector<std::array<const StaticVisibility::Node*, 8>> StaticVisibility::Around(
    const Instant& instant, std::span<const Key> lows, std::vector<NodePtr>* held) const {
  std::vector<Key> keys;
  keys.reserve(8 * lows.size());
  for (const Key low : lows) {
    for (int corner = 0; corner < 8; ++corner) keys.push_back(CornerOf(low, corner));
  }
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
  *held = NodesOf(instant, keys);
  std::vector<std::array<const Node*, 8>> around(lows.size());
  for (std::size_t i = 0; i < lows.size(); ++i) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto at = std::ranges::lower_bound(keys, CornerOf(lows[i], corner)) - keys.begin();
      around[i][static_cast<std::size_t>(corner)] = (*held)[static_cast<std::size_t>(at)].get();
    }
  }
  return around;
}

void StaticVisibility::Shade(const Instant& instant, std::span<const ShadowedPlace> places,
                             EmitterVisibility* visible) const {
  std::vector<Cell> cells;
  std::vector<Key> lows;
  cells.reserve(places.size());
  lows.reserve(places.size());
  for (const ShadowedPlace& place : places) {
    cells.push_back(CellAround(place.surface.position, options_.spacing_m));
    lows.push_back(cells.back().low);
  }
  std::ranges::sort(lows);
  lows.erase(std::ranges::unique(lows).begin(), lows.end());
  std::vector<NodePtr> held;
  const std::vector<std::array<const Node*, 8>> corners = Around(instant, lows, &held);
  ParallelFor(std::size_t{0}, places.size(), [&](std::size_t i) {
    const auto at = std::ranges::lower_bound(lows, cells[i].low) - lows.begin();
    Multiply(corners[static_cast<std::size_t>(at)], cells[i].weights, visible->Row(i));
  });
}

void StaticVisibility::Multiply(const std::array<const Node*, 8>& corners,
                                const std::array<float, 8>& weights, std::span<float> row) {
  float free = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    if (corners[c]->is_free) free += weights[c];
  }
  if (free <= 0) return;  // in a hole narrower than the grid: nothing is known, nothing taken
  for (std::size_t e = 0; e < row.size(); e += kLanes) {
    F8 seen = Wide(0);
    for (std::size_t c = 0; c < 8; ++c) {
      if (!corners[c]->is_free) continue;
      seen += weights[c] / (free * 255) * ToFloat(LoadBytes(&corners[c]->seen[e]));
    }
    const F8 before = LoadF(&row[e]);
    Store(Select(before == EmitterVisibility::kBelowHorizon, before, before * seen), &row[e]);
  }
}

}  // namespace aisle::sim
