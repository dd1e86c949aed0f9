#pragma once

#include <span>
#include <vector>

#include "simulator/shade/light/direct_light.h"
#include "simulator/shade/light/light_volume.h"
#include "simulator/shade/light/point_groups.h"
#include "simulator/shade/light/solve_watch.h"

namespace aisle::sim {

/// The surfaces that exchange light: groups of neighbouring points of a coarse grid.
struct Patches {
  std::vector<SurfacePoint> places;
  std::vector<float> albedo;
  std::vector<float> emitted;           ///< radiosity of their own
  std::vector<std::uint32_t> of_point;  ///< by point of the grid: its patch
};

/// What a grid's points send out: of the light they receive, and by themselves.
struct Leaving {
  std::vector<float> albedo, emitted;
};

/// Groups a grid's points, which are at `points`, within a third of a metre, or more where they are
/// many: coplanar ones, and loose ones that face alike. `things` as of LooseThings.
Patches MakePatches(std::span<const std::uint32_t> things, std::span<const SurfacePoint> points,
                    const Leaving& leaving);

/// Which patch each point of a finer grid over the same mesh lies in.
std::vector<std::uint32_t> PatchesOf(const LightGrid& fine, const LightGrid& coarse,
                                     const Patches& patches);

/// Moves each patch to the one of its fine points that is nearest to their middle: a coarse grid's
/// own points are corners of small things, where more light comes than on their faces.
void CentrePatches(std::span<const SurfacePoint> fine, std::span<const std::uint32_t> patch_of,
                   Patches* patches);

/// Means over patches of values at the fine points, each counting by the area around it; where a
/// patch has no fine point, 0.
std::vector<float> MeanByPatch(const LightGrid& fine, std::span<const float> values,
                               std::span<const std::uint32_t> patch_of, std::size_t patches);

/// A solved exchange of diffuse light between patches.
struct Radiosity {
  std::vector<float> direct;    ///< irradiance by patch
  std::vector<float> indirect;  ///< irradiance by patch
};

struct RadiosityOptions {
  int directions = 64;  ///< rays a patch
  int bounces = 6;
};

/// Solves indirect = gather(albedo · (direct + indirect) + emitted). The watch counts patches.
Radiosity SolveRadiosity(const Instant& statics, const LightGrid& grid, const Patches& patches,
                         std::vector<float> direct, const RadiosityOptions& options,
                         SolveWatch* watch);

/// Fills the volume's nodes with what they see of the solution. The watch counts nodes.
void FillVolume(const Instant& statics, const LightGrid& grid, const TriangleMesh& mesh,
                const Patches& patches, const Radiosity& radiosity, int directions,
                LightVolume* volume, SolveWatch* watch);

}  // namespace aisle::sim
