#include "simulator/shade/pass/mover_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <unordered_map>

namespace aisle::sim {
namespace {

constexpr float kFacingAlike = 0.5f;  // cosine between normals
constexpr float kReach = 2;           // spacings: how far a node's value spreads

struct BodyPoint {
  const SurfacePoint& surface;
  std::uint32_t piece;
};

/// Nodes by piece and cell of space, for looking around a place.
class NodeCells {
 public:
  explicit NodeCells(float cell_m) : cell_m_(cell_m) {}

  void Add(const BodyPoint& point, std::uint32_t node) {
    cells_[KeyOf(CellOf(point.surface.position), point.piece)].push_back(node);
  }
  /// Calls visit(node) for all nodes of the same piece in the 27 cells around.
  template <typename Visit>
  void Around(const BodyPoint& point, const Visit& visit) const {
    const Eigen::Vector3i middle = CellOf(point.surface.position);
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3i cell = middle + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      const auto found = cells_.find(KeyOf(cell, point.piece));
      if (found == cells_.end()) continue;
      for (const std::uint32_t node : found->second) visit(node);
    }
  }

 private:
  Eigen::Vector3i CellOf(const Eigen::Vector3f& position) const {
    return (position / cell_m_).array().floor().cast<int>();
  }
  static std::uint64_t KeyOf(const Eigen::Vector3i& cell, std::uint32_t piece) {
    std::uint64_t key = piece;
    for (int axis = 0; axis < 3; ++axis) {
      key = key << 14 | (static_cast<std::uint64_t>(cell[axis] + (1 << 13)) & 0x3fffu);
    }
    return key;
  }

  float cell_m_;
  // Only looked up, never walked through: its order reaches nothing.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// A point becomes a node unless one that faces alike is near already.
std::vector<std::uint32_t> Spread(std::span<const SurfacePoint> points,
                                  std::span<const std::uint32_t> pieces, float spacing_m) {
  NodeCells cells(spacing_m);
  std::vector<std::uint32_t> nodes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const BodyPoint point{points[i], pieces[i]};
    bool covered = false;
    cells.Around(point, [&](std::uint32_t node) {
      const SurfacePoint& other = points[nodes[node]];
      covered |= (other.position - points[i].position).squaredNorm() < spacing_m * spacing_m &&
                 other.normal.dot(points[i].normal) > kFacingAlike;
    });
    if (covered) continue;
    cells.Add(point, static_cast<std::uint32_t>(nodes.size()));
    nodes.push_back(static_cast<std::uint32_t>(i));
  }
  return nodes;
}

/// The side of a cube that a normal points to.
std::uint64_t SideOf(const Eigen::Vector3f& normal) {
  Eigen::Index axis;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<std::uint64_t>(axis) + (normal[axis] < 0 ? 1 : 0);
}

/// The number of a cell on a curve that fills space (Morton 1966).
std::uint64_t CurveAt(const Eigen::Vector3i& cell) {
  std::uint64_t place = 0;
  for (int bit = 15; bit >= 0; --bit) {
    for (int axis = 0; axis < 3; ++axis) {
      place = place << 1 | static_cast<std::uint64_t>(cell[axis] >> bit & 1);
    }
  }
  return place;
}

std::vector<std::uint32_t> Ordered(std::span<const SurfacePoint> points,
                                   std::span<const std::uint32_t> nodes, float spacing_m) {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t point : nodes) box.extend(points[point].position);
  std::vector<std::tuple<std::uint64_t, std::uint64_t, std::uint32_t>> keys;
  for (std::uint32_t node = 0; node < nodes.size(); ++node) {
    const SurfacePoint& at = points[nodes[node]];
    const Eigen::Vector3i cell = ((at.position - box.min()) / spacing_m).cast<int>();
    keys.emplace_back(SideOf(at.normal), CurveAt(cell), node);
  }
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order;
  for (const auto& [side, place, node] : keys) order.push_back(node);
  return order;
}

MoverNodes::Stencil StencilOf(const BodyPoint& point, std::span<const SurfacePoint> points,
                              const MoverNodes& nodes, const NodeCells& cells) {
  std::vector<std::pair<float, std::uint32_t>> near;
  const float reach = kReach * nodes.spacing_m;
  cells.Around(point, [&](std::uint32_t node) {
    const SurfacePoint& other = points[nodes.points[node]];
    const float distance = (other.position - point.surface.position).norm();
    const float alike = other.normal.dot(point.surface.normal);
    if (distance >= reach || alike <= kFacingAlike) return;
    // A node that faces away counts as if it were farther off.
    near.emplace_back(distance / reach + (1 - alike), node);
  });
  std::ranges::sort(near);
  near.resize(std::min<std::size_t>(near.size(), MoverNodes::kNeighbours));
  MoverNodes::Stencil stencil;
  float sum = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const float weight = std::max(1.0f - near[i].first, 0.01f);
    stencil.nodes[i] = near[i].second;
    stencil.weights[i] = weight * weight;
    sum += stencil.weights[i];
  }
  for (float& weight : stencil.weights) weight /= sum;
  return stencil;
}

}  // namespace

MoverNodes ChooseNodes(std::span<const SurfacePoint> points, std::span<const std::uint32_t> pieces,
                       float spacing_m) {
  MoverNodes nodes{.spacing_m = spacing_m,
                   .points = Spread(points, pieces, spacing_m),
                   .in_order = {},
                   .stencils = {}};
  nodes.in_order = Ordered(points, nodes.points, spacing_m);
  NodeCells cells(kReach * spacing_m);
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    const std::uint32_t point = nodes.points[i];
    cells.Add({points[point], pieces[point]}, static_cast<std::uint32_t>(i));
  }
  nodes.stencils.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    nodes.stencils.push_back(StencilOf({points[i], pieces[i]}, points, nodes, cells));
  }
  return nodes;
}

}  // namespace aisle::sim
