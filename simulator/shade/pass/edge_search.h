#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "simulator/shade/pass/shading_view.h"
#include "simulator/trace/tile_grid.h"

namespace aisle::sim {

struct PixelAt {
  int x, y;
};

/// A pixel on an edge, and the radiance of all that it shows.
struct MixedPixel {
  PixelAt pixel;
  float radiance;
};

/// What is found in a tile.
struct TileEdges {
  std::vector<MixedPixel> mixed;  ///< pixels whose new value is known
  std::vector<PixelAt> unknown;   ///< pixels that need rays
};

/// Looks for places where neighbouring pixels show another thing, face or material, and another
/// brightness (`radiance`, by pixel). Where the edge of the nearer triangle is known to pass
/// between two pixel centres, the pixel it cuts is mixed from both sides by the length it covers
/// (Persson, "Geometric post-process anti-aliasing", 2011). The tile begins at a multiple of eight.
TileEdges FindEdges(const ShadingView& shading, const cv::Mat1f& radiance, const Tile& tile);

}  // namespace aisle::sim
