#pragma once

#include "simulator/shade/surface/surface_point.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// Irradiance that an area light sends to a place were nothing in between: Lambert's formula over
/// the edges of the part of the rectangle that lies above the place's horizon (Baum, Rushmeier and
/// Winget 1989, eq. 7). 0 behind the light.
float UnshadowedIrradiance(const AreaLight& light, const SurfacePoint& place);

}  // namespace aisle::sim
