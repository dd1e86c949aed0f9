#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "simulator/shade/light_grid.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

/// A place that receives light: position, and the unit normal of the side it faces; world.
struct SurfacePoint {
  Eigen::Vector3f position, normal;
};

/// The grid's points on a posed mesh, lifted off the surface and drawn in from the triangle's
/// border by a few millimetres, so that they do not lie inside a neighbour they touch.
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

struct SampledLightOptions {
  int samples = 16;        ///< shadow rays a point
  std::uint32_t turn = 0;  ///< sets another choice of places on the lights
  GeometryMask occluders = kEverything;
};

/// The same at a fixed price: the rays are dealt out to the lights by what these give the packet
/// unshadowed and spread over their areas. Unbiased over `turn`.
std::array<float, kLanes> SampleDirectLight(const Instant& instant,
                                            std::span<const AreaLight> lights,
                                            std::span<const float> light_scale,
                                            std::span<const SurfacePoint> points,
                                            const SampledLightOptions& options);

}  // namespace aisle::sim
