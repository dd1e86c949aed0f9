#pragma once

#include <array>
#include <vector>

#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// What rays meet behind clear panes: four rays on a rotated grid in each of two pixels.
struct BehindClear {
  std::array<std::size_t, 2> pixels{};  ///< as HitImage::Index
  int count = 0;                        ///< of pixels
  Rays8 rays;
  Hits8 hits;
};

/// Traces on where an image shows clear movers. Panes behind panes are taken away as one.
std::vector<BehindClear> TraceBehindClear(const Instant& instant, const CameraView& view,
                                          const HitImage& image);

/// The radiance of what is behind, times what the pane lets through: by pixel, 0 elsewhere.
/// `mover_shadows`: movers darken the static world.
void ShadeBehindClear(const ShadingView& shading, std::span<const BehindClear> behind,
                      bool mover_shadows, std::vector<float>* through);

}  // namespace aisle::sim
