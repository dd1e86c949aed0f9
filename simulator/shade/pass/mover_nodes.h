#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulator/shade/surface/surface_point.h"

namespace aisle::sim {

/// A coarser set of a body's own points, about `spacing_m` apart in its bind pose and facing alike
/// with those they stand for, and how each point's value follows from theirs. What is expensive is
/// asked at the nodes alone.
struct MoverNodes {
  static constexpr int kNeighbours = 6;
  struct Stencil {
    std::array<std::uint32_t, kNeighbours> nodes{};  ///< indices into `points`
    std::array<float, kNeighbours> weights{};        ///< sum to 1; 0 where there are fewer
  };

  float spacing_m = 0;
  std::vector<std::uint32_t> points;  ///< the nodes: indices of the body's points
  /// All nodes, so that those side by side lie near each other and face alike: their rays take like
  /// ways.
  std::vector<std::uint32_t> in_order;
  std::vector<Stencil> stencils;  ///< by point
};

/// `points` of the body in its bind pose; `pieces`, by point: what belongs to another piece of the
/// mesh, as the body under its clothes, says nothing of a point however near it is.
MoverNodes ChooseNodes(std::span<const SurfacePoint> points, std::span<const std::uint32_t> pieces,
                       float spacing_m);

}  // namespace aisle::sim
