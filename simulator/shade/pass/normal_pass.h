#pragma once

#include <vector>

#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// Turns the light of the pixels that show a normal map to the map's normals: direct light by the
/// ratio of what all lamps would give the two normals unshadowed, indirect light by that of the
/// light in the free space around. Does nothing in a world without normal maps.
void BendLight(const ShadingView& shading, std::vector<float>* irradiance);

}  // namespace aisle::sim
