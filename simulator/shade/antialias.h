#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "simulator/shade/frame_light.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

/// Replaces pixels on geometric edges (a neighbour shows another thing, face or material, and
/// another brightness) by the mean of four rays on a rotated grid inside the pixel. `kept` is the
/// share of light that movers leave, per pixel of the image.
void AntialiasEdges(const Instant& instant, const EyeView& view, const HitImage& image,
                    const SurfaceTables& tables, const FrameLight& frame,
                    const TexturePool& textures, std::span<const float> kept, cv::Mat1f* radiance);

}  // namespace aisle::sim
