#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "simulator/shade/pass/shading_view.h"

namespace aisle::sim {

/// Antialiases geometric edges: places where neighbouring pixels show another thing, face or
/// material, and another brightness. Where the edge of the nearer triangle is known to pass between
/// two pixel centres, the pixel it cuts is mixed from both sides by the length it covers (Persson,
/// "Geometric post-process anti-aliasing", 2011); where it is not (thin things, curved outlines),
/// the pixel becomes the mean of four samples on a rotated grid. `kept` is the share of light that
/// movers leave, per pixel of the image.
void AntialiasEdges(const ShadingView& shading, std::span<const float> kept, cv::Mat1f* radiance);

}  // namespace aisle::sim
