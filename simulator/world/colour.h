#pragma once

#include "simulator/world/actors.h"

namespace aisle::sim {

/// What the world's surfaces are like in red, green and blue. Models have their own colours; the
/// kit's sheets those of their pictures, with the wear that was painted over them, and boards and
/// wood a tint that leaves their luminance as it is. What is stored in grey stays grey.
std::vector<BandSurfaces> ColourOf(const WorldParts& parts, const std::vector<Wardrobe::Worn>& worn,
                                   const AssetLibrary& assets);

}  // namespace aisle::sim
