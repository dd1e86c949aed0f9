#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "simulator/mesh/material.h"
#include "simulator/shade/lanes/wide.h"

namespace aisle::sim {

/// Where a normal map is read: texture coordinates and the side of the square that is averaged.
struct MapPoint {
  int texture = -1;
  float u = 0, v = 0, width = 0;
};
/// Normal maps read at once: each takes two of eight lanes.
inline constexpr std::size_t kMapPoints = 4;

/// All albedo textures with their mip pyramids in one block of bytes, so that eight lanes can read
/// eight textures at once. Sides are powers of two (others are resampled), every row ends with a
/// copy of its first texel, and a byte b stands for the linear reflectance (b / 255)²: two-fold
/// finer in the darks than linear bytes, and decoded by one multiplication. Of normal maps, whose
/// middle counts, it stands for the share b / 255 itself.
class TexturePool {
 public:
  /// Texels are found by 32-bit places.
  static constexpr std::size_t kMostBytes = std::numeric_limits<std::int32_t>::max() - 8;

  /// CV_8UC1 are albedo, CV_8UC3 normal maps. Throws std::runtime_error, naming the largest, when
  /// together they take more than `most_bytes`.
  explicit TexturePool(std::span<const Texture> textures, std::size_t most_bytes = kMostBytes);

  /// Mean of the texture over the parallelogram spanned by the screen steps (du_dx, dv_dx) and
  /// (du_dy, dv_dy) around (u, v): up to eight trilinear taps along the longer axis of the
  /// footprint, so floors seen at a grazing angle keep their detail. `texture` is an index, or -1
  /// where the lane has none (gives 1). (0, 0) is the top left corner; coordinates repeat.
  F8 Sample(I8 texture, F8 u, F8 v, F8 du_dx, F8 dv_dx, F8 du_dy, F8 dv_dy) const;

  /// Mean over a square footprint of `width` in texture coordinates; one point.
  float SampleWide(int texture, float u, float v, float width) const;
  /// Mean x and y of a normal map, in [-1, 1], likewise; none where the texture is no normal map.
  Eigen::Vector2f SampleNormal(const MapPoint& point) const {
    return SampleNormals({&point, 1})[0];
  }
  /// The same of up to kMapPoints points at once.
  std::array<Eigen::Vector2f, kMapPoints> SampleNormals(std::span<const MapPoint> points) const;

 private:
  template <bool kNormals>
  F8 Bilinear(I8 texture, I8 size, I8 level, F8 u, F8 v) const;
  template <bool kNormals>
  F8 SampleBytes(I8 texture, F8 u, F8 v, F8 du_dx, F8 dv_dx, F8 du_dy, F8 dv_dy) const;

  static constexpr int kLevels = 14;  ///< up to 8192 texels a side
  std::vector<std::uint8_t> bytes_;
  std::vector<int> second_;            ///< where a normal map's y is kept, by texture; -1: no map
  std::vector<std::int32_t> sizes_;    ///< log2 width | log2 height << 8, by texture + 1
  std::vector<std::int32_t> offsets_;  ///< by (texture + 1)·kLevels + level
};

}  // namespace aisle::sim
