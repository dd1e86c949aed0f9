#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "slam/feature/extract.h"

namespace aisle::slam {

/// What the image shows around a corner: a square of its pyramid level, row by row.
struct FeaturePatch {
  static constexpr int kReach = 7;  ///< pixels of the level from the corner to every side
  static constexpr int kSide = 2 * kReach + 1;
  std::array<std::uint8_t, kSide * kSide> grey{};

  /// Grey level `x` pixels right of and `y` below the corner, each within kReach.
  std::uint8_t At(int x, int y) const {
    return grey[static_cast<std::size_t>((y + kReach) * kSide + x + kReach)];
  }
};

/// The patches of all features, in their order.
std::vector<FeaturePatch> CutPatches(const ImageFeatures& image);

}  // namespace aisle::slam
