#pragma once

#include <vector>

#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// What eight neighbouring pixels mirror: one ray each along a facet of the lobe.
struct Reflection8 {
  int x = 0, y = 0;  ///< of the first
  I8 lanes{};        ///< those that are glossy
  F8x3 to{};         ///< the rays' directions, world
  Hits8 hits{};
  F8 weight{};  ///< of what they meet, in the radiance of the pixel
  F8 lamps{};   ///< radiance of lamps that broad lobes mirror
  F8 base{};    ///< share of the reflectance that the lobe leaves to the diffuse base
};
/// Those of an image, by tile.
using Reflections = std::vector<std::vector<Reflection8>>;

/// Sends the rays of an image's glossy surfaces, in a 4 × 4 pattern. Broad lobes aim a second ray
/// at a lamp. None of it asks what light falls on what is met, so that movers which only mirrors
/// show can be lit first. The memory of what *reflections held is used again.
void TraceGloss(const ShadingView& shading, Reflections* reflections);

/// Appends the hits that met a mover.
void AddMirroredMovers(const Reflections& reflections, std::vector<Hits8>* beyond);

/// The rays' ends are looked up as any pixel is, so lamps, goods and movers are all mirrored, and
/// filtered over the pattern. Writes radiance to `mirrored` (0 elsewhere), and takes from
/// `reflectance` what the lobe leaves to the diffuse base; `raw` is what the filter was given.
/// Returns false, with the last two left as they were, where nothing in the image is glossy.
bool ShadeGloss(const ShadingView& shading, const Reflections& reflections,
                std::vector<float>* reflectance, std::vector<float>* raw,
                std::vector<float>* mirrored);

}  // namespace aisle::sim
