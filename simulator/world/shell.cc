#include "simulator/world/shell.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

namespace aisle::sim {
namespace {

using Eigen::Vector3d;

constexpr double kEncloses = 0.5;   // winding number of a shell, be it without a floor
constexpr double kHasBack = 0.002;  // of a part; a closed one's is none but for rounding

/// Share of all directions under which a triangle is seen, positive from behind (Van Oosterom and
/// Strackee 1983).
double ShareSeen(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return std::atan2(a.dot(b.cross(c)), below) / (2 * std::numbers::pi);
}

std::vector<double> SharesSeen(const Vector3d& from, const TriangleMesh& mesh) {
  std::vector<double> shares;
  shares.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](std::uint32_t corner) -> Vector3d {
      return mesh.positions[corner].cast<double>() - from;
    };
    shares.push_back(ShareSeen(at(a), at(b), at(c)));
  }
  return shares;
}

/// Sets of vertices; each is known by one of its own.
class Sets {
 public:
  explicit Sets(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0u); }
  std::uint32_t Of(std::uint32_t i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  void Join(std::uint32_t a, std::uint32_t b) { above_[Of(a)] = Of(b); }

 private:
  std::vector<std::uint32_t> above_;
};

/// Vertices by parts: joined by a triangle, or at one place of one node.
Sets PartsOf(std::span<const int> nodes, const TriangleMesh& mesh) {
  Sets parts(mesh.positions.size());
  std::vector<int> of_vertex(mesh.positions.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const std::uint32_t corner : mesh.triangles[i]) of_vertex[corner] = nodes[i];
  }
  std::vector<std::uint32_t> by_place(mesh.positions.size());
  std::iota(by_place.begin(), by_place.end(), 0u);
  const auto place = [&](std::uint32_t i) {
    const Eigen::Vector3f& p = mesh.positions[i];
    return std::tuple(of_vertex[i], p.x(), p.y(), p.z());
  };
  std::ranges::sort(by_place, {}, place);
  for (std::size_t i = 1; i < by_place.size(); ++i) {
    if (place(by_place[i]) == place(by_place[i - 1])) parts.Join(by_place[i], by_place[i - 1]);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    parts.Join(a, b);
    parts.Join(a, c);
  }
  return parts;
}

}  // namespace

void TurnShellInside(const Eigen::Vector3f& inside, std::span<const int> nodes,
                     TriangleMesh* mesh) {
  const std::vector<double> shares = SharesSeen(inside.cast<double>(), *mesh);
  if (std::accumulate(shares.begin(), shares.end(), 0.0) <= kEncloses) return;
  Sets parts = PartsOf(nodes, *mesh);
  std::vector<double> of_part(mesh->positions.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    of_part[parts.Of(mesh->triangles[i][0])] += shares[i];
  }
  const auto turns = [&](std::uint32_t vertex) { return of_part[parts.Of(vertex)] > kHasBack; };
  for (auto& corners : mesh->triangles) {
    if (turns(corners[0])) std::swap(corners[1], corners[2]);
  }
  for (std::uint32_t i = 0; i < mesh->normals.size(); ++i) {
    if (turns(i)) mesh->normals[i] = -mesh->normals[i];
  }
}

}  // namespace aisle::sim
