#pragma once

#include <algorithm>
#include <cstddef>

#include "simulator/common/parallel.h"

namespace aisle::sim {

/// The pixels [x0, x1) × [y0, y1).
struct Tile {
  int x0, y0, x1, y1;
};

/// An image cut into tiles of one size, in reading order; those at its right and lower border may
/// be smaller.
struct TileGrid {
  int width, height;            ///< of the image, pixels
  int tile_width, tile_height;  ///< pixels

  int columns() const { return (width + tile_width - 1) / tile_width; }
  int rows() const { return (height + tile_height - 1) / tile_height; }
  std::size_t size() const { return static_cast<std::size_t>(columns() * rows()); }
  Tile At(std::size_t i) const {
    const int x0 = static_cast<int>(i) % columns() * tile_width;
    const int y0 = static_cast<int>(i) / columns() * tile_height;
    return {x0, y0, std::min(x0 + tile_width, width), std::min(y0 + tile_height, height)};
  }
  /// Calls work(i, tile) for each, in parallel.
  template <typename Work>
  void ForEach(const Work& work) const {
    ParallelFor(std::size_t{0}, size(), [&](std::size_t i) { work(i, At(i)); });
  }
};

/// Calls work(x, y) for every step-th pixel of each row of a tile.
template <typename Work>
void ForRows(const Tile& tile, int step, const Work& work) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += step) work(x, y);
  }
}

}  // namespace aisle::sim
