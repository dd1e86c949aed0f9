#pragma once

#include <span>
#include <vector>

#include "simulator/shade/direct_light.h"
#include "simulator/shade/light_volume.h"

namespace aisle::sim {

/// The surfaces that exchange light: groups of neighbouring points of a coarse grid.
struct Patches {
  std::vector<SurfacePoint> places;
  std::vector<float> albedo;
  std::vector<std::uint32_t> of_point;  ///< by point of the grid: its patch
};

/// Groups a grid's points (coplanar ones within a third of a metre); `albedo` is by point.
Patches MakePatches(std::span<const SurfacePoint> points, std::span<const float> albedo);

/// A solved exchange of diffuse light between patches.
struct Radiosity {
  std::vector<float> direct;    ///< irradiance by patch
  std::vector<float> indirect;  ///< irradiance by patch
};

struct RadiosityOptions {
  int directions = 64;  ///< rays a patch
  int bounces = 6;
};

/// Solves indirect = gather(albedo · (direct + indirect)).
Radiosity SolveRadiosity(const Instant& statics, const LightGrid& grid, const Patches& patches,
                         std::vector<float> direct, const RadiosityOptions& options);

/// Fills the volume's nodes with what they see of the solution.
void FillVolume(const Instant& statics, const LightGrid& grid, const TriangleMesh& mesh,
                const Patches& patches, const Radiosity& radiosity, int directions,
                LightVolume* volume);

}  // namespace aisle::sim
