#pragma once

#include <span>
#include <vector>

#include "simulator/shade/frame_light.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

/// What movers take from the light of the static world: `kept` becomes the share of each pixel's
/// irradiance that remains, 1 where no mover can matter. Per pixel one shadow ray a light and mover
/// and a few short rays for indirect light, in a 4 × 4 pattern of directions that a filter over the
/// same surface then averages. `irradiance` is the static world's, in HitImage rows.
void TraceMoverShadows(const Instant& instant, const EyeView& view, const HitImage& image,
                       const World& world, const SurfaceTables& tables, const FrameLight& frame,
                       std::span<const float> irradiance, std::vector<float>* kept);

}  // namespace aisle::sim
