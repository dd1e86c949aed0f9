#pragma once

#include <Eigen/Core>
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

struct DirectLightOptions {
  /// Lights that together give less than this share of a packet's unshadowed light are not traced;
  /// they are taken to be as visible as the others.
  float untraced_share = 0.01f;
  GeometryMask occluders = kEverything;
};

/// Irradiance that up to eight points receive straight from the luminaires, with soft shadows. A
/// light is first probed at four points of its area; where these disagree (penumbra), at sixteen.
/// `light_scale` dims each light. Writes points.size() values.
void DirectIrradiance(const Instant& instant, std::span<const AreaLight> lights,
                      std::span<const float> light_scale, std::span<const SurfacePoint> points,
                      const DirectLightOptions& options, float* irradiance);

}  // namespace aisle::sim
