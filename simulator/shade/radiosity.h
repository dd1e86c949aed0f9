#pragma once

#include <span>
#include <vector>

#include "simulator/shade/direct_light.h"
#include "simulator/shade/light_volume.h"

namespace aisle::sim {

/// A solved exchange of diffuse light between the points of a coarse grid over the static world.
struct Radiosity {
  std::vector<float> direct;    ///< irradiance by point
  std::vector<float> indirect;  ///< irradiance by point
};

struct RadiosityOptions {
  int directions = 96;  ///< a point; rounded down to a whole number of packets
  int bounces = 6;
};

/// Solves indirect = gather(albedo · (direct + indirect)). `albedo` is by point.
Radiosity SolveRadiosity(const Instant& statics, const LightGrid& grid,
                         std::span<const SurfacePoint> points, std::span<const float> albedo,
                         std::vector<float> direct, const RadiosityOptions& options);

/// Fills the volume's nodes with what they see of the solution.
void FillVolume(const Instant& statics, const LightGrid& grid, const TriangleMesh& mesh,
                std::span<const float> albedo, const Radiosity& radiosity, int directions,
                LightVolume* volume);

}  // namespace aisle::sim
