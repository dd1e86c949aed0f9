#pragma once

#include <span>
#include <vector>

#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// What another camera of the same instant found before the filter.
struct SeenShadows {
  const CameraView& view;
  const HitImage& image;
  std::span<const float> raw;
};

/// What movers take from the light of the static world: `kept` becomes the share of each pixel's
/// irradiance that remains, 1 where no mover can matter. Per pixel one shadow ray a light and mover
/// and a few short rays for indirect light, in a 4 × 4 pattern of directions that a filter over the
/// same surface then averages. `irradiance` is the static world's, in HitImage rows. Points that
/// the camera of `seen` (may be null) has traced are taken from there. `raw` is what the filter was
/// given.
void TraceMoverShadows(const ShadingView& shading, std::span<const float> irradiance,
                       const SeenShadows* seen, std::vector<float>* raw, std::vector<float>* kept);

}  // namespace aisle::sim
