#pragma once

#include <vector>

#include "simulator/shade/light/light_state.h"
#include "simulator/shade/surface/light_grid.h"
#include "simulator/shade/surface/texture_pool.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// What each point of a grid sends on of the light it receives, over `texel` metres: the diffuse
/// base, and what its lobe mirrors, whose energy must not be lost though radiosity spreads it as if
/// it were diffuse.
std::vector<float> ReflectanceAt(const World& world, const TexturePool& textures,
                                 const LightGrid& grid, float texel);

/// Whether anything of the static world shines and is no lamp's.
bool HasSky(const World& world);

/// What each point of a grid sends out by itself: π · emission of what shines and is no lamp's,
/// which is the sky, dimmed by `sky`. A lamp's light is traced.
std::vector<float> EmittedAt(const World& world, const LightGrid& grid, float sky);

/// Makes luminaires show their own radiance beside what they reflect: their light is read at
/// reflectance 1, so that the irradiance there becomes albedo · irradiance + π · emission.
void PaintLuminaires(const World& world, const TexturePool& textures, const LightGrid& grid,
                     float texel, std::span<const float> light_scale, float sky, LightState* state);

}  // namespace aisle::sim
