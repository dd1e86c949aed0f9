#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "simulator/shade/pass/edge_search.h"

namespace aisle::sim {

/// Four rays on a rotated grid in each of up to two pixels.
Rays8 SampleRays(const CameraView& view, std::span<const PixelAt> pixels);

/// The mean radiance of four samples on a rotated grid in each of the pixels. `kept` is the share
/// of light that movers leave, by pixel; `radiance` that of the pixels' centres, which samples of
/// the same surface take over.
std::vector<MixedPixel> SamplePixels(const ShadingView& shading, std::span<const float> kept,
                                     const cv::Mat1f& radiance, std::span<const PixelAt> pixels);

}  // namespace aisle::sim
