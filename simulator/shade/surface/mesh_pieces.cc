#include "simulator/shade/surface/mesh_pieces.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace aisle::sim {
namespace {

/// Disjoint sets of vertices; each is named by its least.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t Find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::uint32_t a, std::uint32_t b) {
    a = Find(a);
    b = Find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<std::uint32_t> PiecesOf(const TriangleMesh& mesh) {
  Sets sets(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.Join(a, b);
    sets.Join(a, c);
  }
  const auto place = [&](std::uint32_t i) {
    const Eigen::Vector3f& p = mesh.positions[i];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, place);
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (place(order[i]) == place(order[i - 1])) sets.Join(order[i], order[i - 1]);
  }
  std::vector<std::uint32_t> pieces;
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) pieces.push_back(sets.Find(i));
  return pieces;
}

}  // namespace aisle::sim
