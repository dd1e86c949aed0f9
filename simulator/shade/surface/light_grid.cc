#include "simulator/shade/surface/light_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

constexpr int kMaxCells = 2048;  // along an edge

int Cells(float length, float texel) {
  return std::clamp(static_cast<int>(std::ceil(length / texel)), 1, kMaxCells);
}

/// Barycentrics (u, v) of the grid coordinates (a, b) in [0, 1]² along the two edges that leave
/// corner `origin`.
Eigen::Vector2f Barycentrics(int origin, float a, float b) {
  if (origin == 0) return {a, b};          // to corner 1, to corner 2
  if (origin == 1) return {1 - a - b, a};  // to corner 2, to corner 0
  return {b, 1 - a - b};                   // to corner 0, to corner 1
}

struct Layout {
  int origin, columns, rows;  // cells along the two edges that leave the origin
};

Layout LayOut(const TriangleMesh& mesh, std::size_t triangle, float texel) {
  const auto& [i, j, k] = mesh.triangles[triangle];
  const std::array<const Eigen::Vector3f*, 3> p = {&mesh.positions[i], &mesh.positions[j],
                                                   &mesh.positions[k]};
  // The longest edge becomes the hypotenuse; the grid's origin is the corner opposite to it.
  std::array<float, 3> length;  // of the edge opposite to each corner
  for (std::size_t c = 0; c < 3; ++c) length[c] = (*p[(c + 1) % 3] - *p[(c + 2) % 3]).norm();
  const auto origin = static_cast<std::size_t>(std::ranges::max_element(length) - length.begin());
  return {static_cast<int>(origin), Cells(length[(origin + 2) % 3], texel),
          Cells(length[(origin + 1) % 3], texel)};
}

std::size_t SlotsOf(const Layout& layout) {
  return static_cast<std::size_t>(layout.columns + 1) * static_cast<std::size_t>(layout.rows + 1);
}

LightPatch MakePatch(const Layout& layout, std::int32_t slot) {
  const auto s = static_cast<float>(layout.columns), t = static_cast<float>(layout.rows);
  LightPatch patch;
  patch.slot = slot;
  patch.pitch = layout.columns + 1;
  if (layout.origin == 0) {
    patch.su = s;
    patch.tv = t;
  } else if (layout.origin == 1) {
    patch.sv = s;
    patch.t0 = t;
    patch.tu = patch.tv = -t;
  } else {
    patch.s0 = s;
    patch.su = patch.sv = -s;
    patch.tu = t;
  }
  return patch;
}

class Builder {
 public:
  Builder(const TriangleMesh& mesh, std::span<const Layout> layouts)
      : mesh_(mesh), point_of_vertex_(mesh.positions.size(), LightGrid::kUnused) {
    // A street has millions of patches: to move them as they grow in number costs as much again.
    std::size_t slots = 0;
    for (const Layout& layout : layouts) slots += SlotsOf(layout);
    grid_.patches.reserve(layouts.size());
    grid_.point_of_slot.reserve(slots);
  }

  void Add(std::uint32_t triangle, const Layout& layout) {
    grid_.patches.push_back(
        MakePatch(layout, static_cast<std::int32_t>(grid_.point_of_slot.size())));
    if (layout.columns == 1 && layout.rows == 1) {
      AddSmall(triangle, layout.origin);
    } else {
      AddLarge(triangle, layout);
    }
  }
  LightGrid Take(float texel) {
    grid_.spacing_m = texel;
    return std::move(grid_);
  }

 private:
  std::uint32_t NewPoint(std::uint32_t triangle, const Eigen::Vector2f& uv) {
    grid_.points.push_back({triangle, uv.x(), uv.y()});
    return static_cast<std::uint32_t>(grid_.points.size() - 1);
  }

  void AddSmall(std::uint32_t triangle, int origin) {
    constexpr std::array<std::array<float, 2>, 3> kCorners = {{{0, 0}, {1, 0}, {0, 1}}};
    for (const auto& [a, b] : kCorners) {
      const Eigen::Vector2f uv = Barycentrics(origin, a, b);
      const int corner = uv.x() > 0.5f ? 1 : uv.y() > 0.5f ? 2 : 0;
      std::uint32_t& point =
          point_of_vertex_[mesh_.triangles[triangle][static_cast<std::size_t>(corner)]];
      if (point == LightGrid::kUnused) point = NewPoint(triangle, uv);
      grid_.point_of_slot.push_back(point);
    }
    grid_.point_of_slot.push_back(LightGrid::kExtrapolated);
  }

  void AddLarge(std::uint32_t triangle, const Layout& layout) {
    const auto where = [&](int column, int row) {
      return static_cast<float>(column) / static_cast<float>(layout.columns) +
             static_cast<float>(row) / static_cast<float>(layout.rows);
    };
    constexpr float kInside = 1 + 1e-5f;
    for (int row = 0; row <= layout.rows; ++row) {
      for (int column = 0; column <= layout.columns; ++column) {
        std::uint32_t point = LightGrid::kUnused;
        const float sum = where(column, row);
        const float a = static_cast<float>(column) / static_cast<float>(layout.columns);
        const float b = static_cast<float>(row) / static_cast<float>(layout.rows);
        if (sum <= kInside) {
          point = NewPoint(triangle, Barycentrics(layout.origin, a, b));
        } else if (column > 0 && row > 0 && where(column - 1, row) <= kInside &&
                   where(column, row - 1) <= kInside) {
          point = LightGrid::kExtrapolated;
        } else if (where(std::max(column - 1, 0), std::max(row - 1, 0)) < kInside) {
          point = NewPoint(triangle, Barycentrics(layout.origin, a / sum, b / sum));
        }
        grid_.point_of_slot.push_back(point);
      }
    }
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> point_of_vertex_;
  LightGrid grid_;
};

struct Cell {
  std::size_t slot, pitch;
  float fs, ft;
};

Cell FindCell(const LightPatch& patch, float u, float v) {
  const float s = std::max(0.0f, patch.s0 + patch.su * u + patch.sv * v);
  const float t = std::max(0.0f, patch.t0 + patch.tu * u + patch.tv * v);
  const float last_s = static_cast<float>(patch.pitch - 2);
  const float last_t = std::max(patch.t0, std::max(patch.tu, patch.tv)) - 1;
  const float s_floor = std::min(std::floor(s), last_s), t_floor = std::min(std::floor(t), last_t);
  return {static_cast<std::size_t>(patch.slot + static_cast<std::int32_t>(t_floor) * patch.pitch +
                                   static_cast<std::int32_t>(s_floor)),
          static_cast<std::size_t>(patch.pitch), s - s_floor, t - t_floor};
}

}  // namespace

LightGrid MakeLightGrid(const TriangleMesh& mesh, float texel_m) {
  std::vector<Layout> layouts(mesh.triangles.size());
  ParallelFor(std::size_t{0}, layouts.size(),
              [&](std::size_t i) { layouts[i] = LayOut(mesh, i, texel_m); });
  Builder builder(mesh, layouts);
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    builder.Add(static_cast<std::uint32_t>(i), layouts[i]);
  }
  return builder.Take(texel_m);
}

std::size_t PointsAbout(const TriangleMesh& mesh, float texel_m) {
  constexpr std::size_t kPart = 65536;
  const std::size_t triangles = mesh.triangles.size();
  std::vector<std::size_t> points((triangles + kPart - 1) / kPart);
  ParallelFor(std::size_t{0}, points.size(), [&](std::size_t part) {
    const std::size_t end = std::min((part + 1) * kPart, triangles);
    for (std::size_t i = part * kPart; i < end; ++i) {
      const Layout layout = LayOut(mesh, i, texel_m);
      const auto columns = static_cast<std::size_t>(layout.columns),
                 rows = static_cast<std::size_t>(layout.rows);
      if (columns * rows == 1) continue;
      points[part] += ((columns + 1) * (rows + 1) + columns + rows) / 2;
    }
  });
  return std::accumulate(points.begin(), points.end(), std::size_t{0});
}

void FillSlots(const LightGrid& grid, std::span<const float> point_values,
               std::span<float> slot_values) {
  for (std::size_t i = 0; i < grid.patches.size(); ++i) {
    const auto first = static_cast<std::size_t>(grid.patches[i].slot);
    const std::size_t end = i + 1 < grid.patches.size()
                                ? static_cast<std::size_t>(grid.patches[i + 1].slot)
                                : grid.point_of_slot.size();
    const auto pitch = static_cast<std::size_t>(grid.patches[i].pitch);
    for (std::size_t slot = first; slot < end; ++slot) {
      const std::uint32_t point = grid.point_of_slot[slot];
      slot_values[slot] = point == LightGrid::kUnused ? 0
                          : point == LightGrid::kExtrapolated
                              ? std::max(0.0f, slot_values[slot - 1] + slot_values[slot - pitch] -
                                                   slot_values[slot - pitch - 1])
                              : point_values[point];
    }
  }
}

std::uint32_t NearestPoint(const LightGrid& grid, std::uint32_t triangle, float u, float v) {
  const Cell cell = FindCell(grid.patches[triangle], u, v);
  const std::size_t slot = cell.slot + (cell.ft > 0.5f ? cell.pitch : 0) + (cell.fs > 0.5f ? 1 : 0);
  const std::uint32_t point = grid.point_of_slot[slot];
  if (point < LightGrid::kExtrapolated) return point;
  return grid.point_of_slot[cell.slot];  // inside the triangle, as the hit is
}

float ReadLight(const LightPatch& patch, std::span<const float> slot_values, float u, float v) {
  const Cell cell = FindCell(patch, u, v);
  const float* row = slot_values.data() + cell.slot;
  const float top = row[0] + (row[1] - row[0]) * cell.fs;
  const float bottom = row[cell.pitch] + (row[cell.pitch + 1] - row[cell.pitch]) * cell.fs;
  return top + (bottom - top) * cell.ft;
}

}  // namespace aisle::sim
