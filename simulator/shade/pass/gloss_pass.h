#pragma once

#include <vector>

#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// What an image's glossy surfaces mirror: one ray a pixel along a facet of the lobe, in a 4 × 4
/// pattern, filtered over the pattern; the ray's end is looked up as any pixel is, so lamps, goods
/// and movers are all mirrored. Broad lobes aim a second ray at a lamp instead. Writes radiance to
/// `mirrored` (0 elsewhere), and takes from `reflectance` what the lobe leaves to the diffuse base.
/// Returns false, with `mirrored` left as it was, where nothing in the image is glossy.
bool TraceGloss(const ShadingView& shading, std::vector<float>* reflectance,
                std::vector<float>* mirrored);

}  // namespace aisle::sim
