#include "simulator/shade/pass/antialias.h"

#include "simulator/shade/pass/edge_samples.h"
#include "simulator/shade/pass/edge_search.h"

namespace aisle::sim {
namespace {

constexpr int kTileWidth = 64, kTileHeight = 16;

}  // namespace

void AntialiasEdges(const ShadingView& shading, std::span<const float> kept, cv::Mat1f* radiance) {
  const TileGrid grid{shading.image.width, shading.image.height, kTileWidth, kTileHeight};
  std::vector<std::vector<MixedPixel>> tiles(grid.size());
  grid.ForEach([&](std::size_t i, const Tile& tile) {
    TileEdges found = FindEdges(shading, *radiance, tile);
    tiles[i] = std::move(found.mixed);
    if (found.unknown.empty()) return;
    const std::vector<MixedPixel> sampled = SamplePixels(shading, kept, *radiance, found.unknown);
    tiles[i].insert(tiles[i].end(), sampled.begin(), sampled.end());
  });
  // All new values are known before the first pixel changes.
  for (const std::vector<MixedPixel>& tile : tiles) {
    for (const auto& [pixel, mixed] : tile) (*radiance)(pixel.y, pixel.x) = mixed;
  }
}

}  // namespace aisle::sim
