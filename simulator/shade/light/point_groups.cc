#include "simulator/shade/light/point_groups.h"

#include <Eigen/Geometry>
#include <cmath>
#include <unordered_map>

#include "simulator/shade/surface/mesh_pieces.h"

namespace aisle::sim {
namespace {

/// Keys of numbers without padding. Only looked up, never walked through: no order reaches a
/// result.
template <typename Key>
struct PartsHash {
  std::size_t operator()(const Key& key) const {
    std::size_t value = 0;
    for (const auto part : key) {
      value = (value ^ static_cast<std::size_t>(part)) * 0x9e3779b97f4a7c15u;
      value ^= value >> 29;
    }
    return value;
  }
};

/// For each of so many the first with the same key.
template <typename Key, typename KeyOf>
std::vector<std::uint32_t> FirstOfEach(std::size_t count, const KeyOf& key_of) {
  std::unordered_map<Key, std::uint32_t, PartsHash<Key>> first(count / 2);
  std::vector<std::uint32_t> firsts;
  firsts.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    firsts.push_back(first.try_emplace(key_of(i), index).first->second);
  }
  return firsts;
}

std::array<int, 3> Rounded(const Eigen::Vector3f& normal, float steps) {
  const auto round = [&](float n) { return static_cast<int>(std::lround(steps * n)); };
  return {round(normal.x()), round(normal.y()), round(normal.z())};
}

}  // namespace

Things ThingsOf(const TriangleMesh& mesh) {
  Things things{PiecesOf(mesh), {}};
  std::vector<Eigen::AlignedBox3f> boxes(mesh.positions.size());
  for (std::size_t v = 0; v < boxes.size(); ++v) {
    boxes[things.of_vertex[v]].extend(mesh.positions[v]);
  }
  things.size_m.reserve(boxes.size());
  for (const Eigen::AlignedBox3f& box : boxes) {
    things.size_m.push_back(box.isEmpty() ? 0 : box.sizes().maxCoeff());
  }
  return things;
}

std::vector<std::uint32_t> LooseThings(const LightGrid& grid, const TriangleMesh& mesh,
                                       const Things& things) {
  std::vector<std::uint32_t> loose;
  loose.reserve(grid.points.size());
  for (const LightPoint& point : grid.points) {
    const std::uint32_t thing = things.of_vertex[mesh.triangles[point.triangle][0]];
    loose.push_back(things.size_m[thing] <= grid.spacing_m / 2 ? thing : kFixed);
  }
  return loose;
}

std::vector<std::uint32_t> GroupsOfThings(std::span<const SurfacePoint> points,
                                          std::span<const std::uint32_t> things) {
  constexpr float kSteps = 1.5f;
  using Key = std::array<int, 4>;
  return FirstOfEach<Key>(points.size(), [&](std::size_t i) {
    const std::array<int, 3> facing = Rounded(points[i].normal, kSteps);
    return Key{static_cast<int>(things[i]), facing[0], facing[1], facing[2]};
  });
}

std::vector<std::uint32_t> GroupsOf(std::span<const SurfacePoint> points,
                                    std::span<const std::uint32_t> things,
                                    const GroupOptions& options) {
  using Key = std::array<int, 8>;
  return FirstOfEach<Key>(points.size(), [&](std::size_t i) {
    const auto& [position, normal] = points[i];
    const bool is_loose = !things.empty() && things[i] != kFixed;
    const auto cell = [&](float at, float size) { return static_cast<int>(std::floor(at / size)); };
    const std::array<int, 3> facing = Rounded(normal, options.normal_steps);
    return Key{cell(position.x(), options.cell_m),
               cell(position.y(), options.cell_m),
               cell(position.z(), options.cell_m),
               facing[0],
               facing[1],
               facing[2],
               is_loose ? 0 : cell(normal.dot(position), options.plane_m),
               is_loose ? 1 : 0};
  });
}

}  // namespace aisle::sim
