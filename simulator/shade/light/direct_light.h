#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "simulator/shade/surface/light_grid.h"
#include "simulator/shade/surface/surface_point.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

/// A grid's point on a posed mesh, lifted off the surface and drawn in from the triangle's border
/// by a few millimetres, so that it does not lie inside a neighbour it touches.
SurfacePoint LocatePoint(const LightPoint& point, const TriangleMesh& topology,
                         std::span<const Eigen::Vector3f> positions,
                         std::span<const Eigen::Vector3f> normals);
/// All of them.
std::vector<SurfacePoint> LocatePoints(const LightGrid& grid, const TriangleMesh& topology,
                                       std::span<const Eigen::Vector3f> positions,
                                       std::span<const Eigen::Vector3f> normals);

struct GroupOptions {
  float cell_m = 0.06f;       ///< points in one cell of this size may share a group
  float normal_steps = 1.5f;  ///< a normal's components are rounded to 1 / this
  float plane_m = 1e3f;       ///< points of a group lie on planes at most so far apart
};

/// Groups points that are near and face alike; for each point, its group's first.
std::vector<std::uint32_t> GroupsOf(std::span<const SurfacePoint> points,
                                    const GroupOptions& options);

struct DirectLightOptions {
  /// Lights that together give less than this share of a packet's unshadowed light are not traced;
  /// they are taken to be as visible as the others.
  float untraced_share = 0.03f;
  std::uint32_t turn =
      0;  ///< each point has its own places on the lights, the k-th those of turn + k
  GeometryMask occluders = kEverything;
};

/// Irradiance that up to eight points receive straight from the luminaires, with soft shadows, from
/// 4 to 32 places on each, by what it gives. `light_scale` dims each light. One result a point.
std::array<float, kLanes> GatherDirectLight(const Instant& instant,
                                            std::span<const AreaLight> lights,
                                            std::span<const float> light_scale,
                                            std::span<const SurfacePoint> points,
                                            const DirectLightOptions& options);

}  // namespace aisle::sim
