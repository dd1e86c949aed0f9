#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "simulator/shade/light/emitter_visibility.h"

namespace aisle::sim {

struct StaticVisibilityOptions {
  float spacing_m = 0.2f;       ///< of the nodes
  float rays_per_share = 1024;  ///< shadow rays of a node, times an emitter's share of its light
  int least_rays = 16, most_rays = 128;  ///< for one emitter
  std::size_t most_nodes = 1u << 20;     ///< kept; then all are forgotten and found again as needed
};

/// How much of each emitter the static world leaves free, in free space: known at the nodes of a
/// world-fixed grid, linear in between, so that what passes through a shadow darkens smoothly and
/// the same place gets the same light in every frame. Nodes are traced when they are first asked
/// for; what they say depends on nothing but the world. Nodes inside solid things do not count.
class StaticVisibility {
 public:
  /// `emitters` and `topology` (the static mesh, for its faces) must outlive it.
  StaticVisibility(const Emitters& emitters, const TriangleMesh& topology,
                   const StaticVisibilityOptions& options);

  /// Multiplies each row by what the static world leaves of the emitters. Lamps that are off count
  /// as well. Thread-safe.
  void Shade(const Instant& instant, std::span<const ShadowedPlace> places,
             EmitterVisibility* visible) const;

 private:
  using Key = std::uint64_t;
  struct Node {
    bool is_free = true;
    std::vector<std::uint8_t> seen;  ///< by emitter, in whole packets, 255: all of it
  };
  using NodePtr = std::shared_ptr<const Node>;

  Eigen::Vector3f PositionOf(Key key) const;
  Node Trace(const Instant& instant, Key key) const;
  bool InsideSomething(const Instant& instant, const Eigen::Vector3f& position) const;
  /// The nodes of the keys, traced where they are new.
  std::vector<NodePtr> NodesOf(const Instant& instant, std::span<const Key> keys) const;
  /// The eight nodes of each cell, given by its lowest; `held` keeps them.
  std::vector<std::array<const Node*, 8>> Around(const Instant& instant, std::span<const Key> lows,
                                                 std::vector<NodePtr>* held) const;
  /// Multiplies a row by what nodes with these weights leave.
  static void Multiply(const std::array<const Node*, 8>& corners,
                       const std::array<float, 8>& weights, std::span<float> row);

  const Emitters& emitters_;
  const TriangleMesh& topology_;
  StaticVisibilityOptions options_;
  std::vector<float> all_on_;
  mutable std::mutex mutex_;  ///< guards nodes_
  mutable std::unordered_map<Key, NodePtr> nodes_;
};

}  // namespace aisle::sim
