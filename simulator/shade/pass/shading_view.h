#pragma once

#include "simulator/shade/pass/frame_light.h"
#include "simulator/shade/surface/texture_pool.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

/// One camera's picture of an instant on its way from hits to radiance: what every pass over its
/// pixels reads. All must outlive it.
struct ShadingView {
  const Instant& instant;
  const CameraView& view;
  const HitImage& image;  ///< of `view`
  const SurfaceTables& tables;
  const FrameLight& frame;
  const TexturePool& textures;

  const World& world() const { return tables.world(); }
};

}  // namespace aisle::sim
