#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulator/mesh/triangle_mesh.h"
#include "simulator/shade/surface/light_grid.h"
#include "simulator/shade/surface/surface_point.h"

namespace aisle::sim {

/// Of a point that lies on no loose thing.
inline constexpr std::uint32_t kFixed = 0xffffffffu;

/// What hangs together: the pieces of a mesh, and how large they are.
struct Things {
  std::vector<std::uint32_t> of_vertex;  ///< as of PiecesOf
  std::vector<float> size_m;             ///< longest side of the box around it, at that vertex
};
Things ThingsOf(const TriangleMesh& mesh);

/// By point the number of the loose thing that it lies on: one no larger than half the grid's
/// spacing, as a leaf is; else kFixed.
std::vector<std::uint32_t> LooseThings(const LightGrid& grid, const TriangleMesh& mesh,
                                       const Things& things);

/// Groups the points of each thing that face alike; for each point, its group's first.
std::vector<std::uint32_t> GroupsOfThings(std::span<const SurfacePoint> points,
                                          std::span<const std::uint32_t> things);

struct GroupOptions {
  float cell_m = 0.06f;       ///< points in one cell of this size may share a group
  float normal_steps = 1.5f;  ///< a normal's components are rounded to 1 / this
  float plane_m = 1e3f;       ///< fixed points of a group lie on planes at most so far apart
};

/// Groups points that are near and face alike, loose ones with loose ones: the leaves of a tree lie
/// on no common plane. `things` is by point; empty: all are fixed.
std::vector<std::uint32_t> GroupsOf(std::span<const SurfacePoint> points,
                                    std::span<const std::uint32_t> things,
                                    const GroupOptions& options);

}  // namespace aisle::sim
