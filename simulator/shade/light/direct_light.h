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
SurfacePoint LocatePoint(const LightGrid& grid, std::size_t index, const TriangleMesh& topology,
                         std::span<const Eigen::Vector3f> positions,
                         std::span<const Eigen::Vector3f> normals);
/// All of them.
std::vector<SurfacePoint> LocatePoints(const LightGrid& grid, const TriangleMesh& topology,
                                       std::span<const Eigen::Vector3f> positions,
                                       std::span<const Eigen::Vector3f> normals);

struct DirectLightOptions {
  /// Lights that together give less than this share of a packet's unshadowed light are not traced;
  /// they are taken to be as visible as the others.
  float untraced_share = 0.03f;
  int rays = 128;  ///< to all lights together: to each by what it gives of the light, 2 to 32
  std::uint32_t turn =
      0;  ///< each point has its own places on the lights, the k-th those of turn + k
  GeometryMask occluders = kEverything;
};

/// Irradiance that up to eight points would receive straight from the luminaires, were nothing in
/// between; those far off are taken to be where their centres are. `light_scale` dims each light.
/// One result a point.
std::array<float, kLanes> UnshadowedLight(std::span<const AreaLight> lights,
                                          std::span<const float> light_scale,
                                          std::span<const SurfacePoint> points);

/// The same with soft shadows, from places on each light, by what it gives.
std::array<float, kLanes> GatherDirectLight(const Instant& instant,
                                            std::span<const AreaLight> lights,
                                            std::span<const float> light_scale,
                                            std::span<const SurfacePoint> points,
                                            const DirectLightOptions& options);

}  // namespace aisle::sim
