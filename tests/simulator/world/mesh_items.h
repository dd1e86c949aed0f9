#pragma once

#include <numeric>

#include "simulator/world/world.h"

namespace aisle::sim::test {

using Box = Eigen::AlignedBox3f;

/// The boxes around the things a mesh is made of, in `frame`: triangles whose corners lie on one
/// another (within 0.1 mm) are one thing.
inline std::vector<Box> ItemsOf(const TriangleMesh& mesh, const std::vector<std::size_t>& triangles,
                                const Eigen::Isometry3f& frame = Eigen::Isometry3f::Identity()) {
  constexpr float kSame_m = 1e-4f;
  std::vector<std::uint32_t> used;
  for (const std::size_t i : triangles) {
    used.insert(used.end(), mesh.triangles[i].begin(), mesh.triangles[i].end());
  }
  std::ranges::sort(used, {}, [&](std::uint32_t v) { return std::pair(mesh.positions[v].x(), v); });
  used.erase(std::ranges::unique(used).begin(), used.end());
  std::vector<std::uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto of = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t a = 0; a < used.size(); ++a) {
    for (std::size_t b = a + 1; b < used.size(); ++b) {
      const Eigen::Vector3f way = mesh.positions[used[b]] - mesh.positions[used[a]];
      if (way.x() > kSame_m) break;
      if (way.cwiseAbs().maxCoeff() <= kSame_m) parent[of(used[a])] = of(used[b]);
    }
  }
  for (const std::size_t i : triangles) {
    for (const std::uint32_t v : mesh.triangles[i]) parent[of(v)] = of(mesh.triangles[i][0]);
  }
  std::map<std::uint32_t, Box> boxes;
  for (const std::uint32_t v : used) {
    boxes[of(v)].extend(frame.inverse() * mesh.positions[v]);
  }
  std::vector<Box> items;
  for (const auto& [root, box] : boxes) items.push_back(box);
  return items;
}

inline std::vector<Box> ItemsOf(const TriangleMesh& mesh) {
  std::vector<std::size_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return ItemsOf(mesh, all);
}

/// The triangles of the static world that belong to an instance of that name.
inline std::vector<std::size_t> TrianglesOf(const std::vector<Instance>& instances,
                                            const StaticWorld& statics, const std::string& name) {
  std::vector<std::size_t> triangles;
  for (std::size_t i = 0; i < statics.instances.size(); ++i) {
    if (instances[statics.instances[i]].name == name) triangles.push_back(i);
  }
  return triangles;
}

/// How far two boxes are in one another: the shortest way apart, negative when they are apart.
inline float Overlap(const Box& a, const Box& b) {
  return (a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min())).minCoeff();
}

inline double AreaOf(const TriangleMesh& mesh, const std::vector<std::size_t>& triangles) {
  double area = 0;
  for (const std::size_t i : triangles) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3f across =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    area += across.norm() / 2;
  }
  return area;
}

}  // namespace aisle::sim::test
