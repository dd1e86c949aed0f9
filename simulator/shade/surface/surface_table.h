#pragma once

#include <span>
#include <vector>

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/surface/light_grid.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// What shading needs to know of a triangle, in one record of floats that eight lanes can gather
/// from. Integers are stored as their bits.
struct SurfaceRecord {
  float normal[3];       ///< unit, geometric, world
  float du[3], dv[3];    ///< gradient of the texture coordinates along the surface, 1/m, world
  float uv0[2];          ///< texture coordinates at the first corner
  float uv1[2], uv2[2];  ///< what the barycentrics u and v add to them
  float albedo;          ///< of the material
  std::int32_t texture;  ///< of the material, -1: none
  float f0,
      roughness;  ///< of its glossy lobe; f0 is 0 where it has none, -1 on luminaires that shine
  LightPatch light;
};
static_assert(sizeof(SurfaceRecord) == 27 * sizeof(float));

/// What becomes of triangles whose material emits.
enum class Luminaires {
  kShine,    ///< of the static world: what they show, reflection included, is stored as light on
             ///< them (StaticLight), so that their reflectance is 1 and their texture none
  kReflect,  ///< of movers, which light nothing: they are surfaces like others
};

/// A record per triangle. `patches` is the mesh's light grid.
std::vector<SurfaceRecord> MakeSurfaceTable(const TriangleMesh& mesh,
                                            std::span<const Eigen::Vector3f> positions,
                                            std::span<const LightPatch> patches,
                                            std::span<const Material> materials,
                                            Luminaires luminaires);

/// Updates what a mover's pose changes: normals and gradients.
void PoseSurfaceTable(const TriangleMesh& mesh, std::span<const Eigen::Vector3f> positions,
                      std::span<SurfaceRecord> table);

}  // namespace aisle::sim
