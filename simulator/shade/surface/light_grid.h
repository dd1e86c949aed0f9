#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "simulator/mesh/triangle_mesh.h"

namespace aisle::sim {

/// Where on a mesh light is evaluated: at barycentrics (u, v) of a triangle.
struct LightPoint {
  std::uint32_t triangle = 0;
  float u = 0, v = 0;
};

/// How a triangle's barycentrics find its patch: grid coordinates s = s0 + su·u + sv·v and
/// t = t0 + tu·u + tv·v; the value is bilinear between slots slot + floor(t)·pitch + floor(s) and
/// its right and lower neighbours.
struct LightPatch {
  float s0 = 0, su = 0, sv = 0, t0 = 0, tu = 0, tv = 0;
  std::int32_t slot = 0, pitch = 2;
};

/// A grid of points over every triangle of a mesh, about `texel` apart, laid along the triangle's
/// two shorter edges, so that irradiance can be stored on the surface itself (no unwrapping, no
/// seams to pack). Triangles smaller than a texel share the points at their vertices. Points are
/// what is evaluated; slots are what is read, several of which may show one point.
struct LightGrid {
  float spacing_m = 0;              ///< as it was asked for
  std::vector<LightPatch> patches;  ///< per triangle
  std::vector<LightPoint> points;
  std::vector<std::uint32_t> point_of_slot;  ///< or kUnused, kExtrapolated

  static constexpr std::uint32_t kUnused = 0xffffffffu;
  /// Beyond the triangle's long edge: left + upper - upper left neighbour, so that the cell is
  /// linear.
  static constexpr std::uint32_t kExtrapolated = 0xfffffffeu;
};

LightGrid MakeLightGrid(const TriangleMesh& mesh, float texel_m);

/// About how many points a grid of that spacing gives the triangles that have points of their own.
std::size_t PointsAbout(const TriangleMesh& mesh, float texel_m);

/// The slots' values from the points'.
void FillSlots(const LightGrid& grid, std::span<const float> point_values,
               std::span<float> slot_values);

/// The point nearest to a hit.
std::uint32_t NearestPoint(const LightGrid& grid, std::uint32_t triangle, float u, float v);

/// Bilinear value at a hit in a triangle's patch.
float ReadLight(const LightPatch& patch, std::span<const float> slot_values, float u, float v);

}  // namespace aisle::sim
