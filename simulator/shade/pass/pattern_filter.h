#pragma once

#include <array>
#include <span>
#include <vector>

#include "simulator/shade/surface/surface_table.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

inline constexpr int kPatternSize = 16;

/// Which of sixteen samples a pixel takes: each 4 × 4 block has them all, and neighbours differ
/// much.
inline int PatternIndex(int x, int y) {
  constexpr std::array<int, kPatternSize> kOrder = {0, 8,  2, 10, 12, 4, 14, 6,
                                                    3, 11, 1, 9,  15, 7, 13, 5};
  return kOrder[static_cast<std::size_t>((y & 3) * 4 + (x & 3))];
}

/// Means over the 4 × 4 pattern of samples around each pixel, of pixels that show the same surface:
/// what was sampled with one ray a pixel becomes sixteen. On a mover, all that is about as far away
/// counts as the same surface.
class PatternFilter {
 public:
  /// `raw` has a value per pixel of the image, rows as there; all three must outlive the filter.
  PatternFilter(const HitImage& image, std::span<const SurfaceRecord> statics,
                std::span<const float> raw)
      : image_(image), statics_(statics), raw_(raw) {}

  /// Writes the means (not below 0) of the wanted ones of the pixels (x, y) to (x + 7, y); x is a
  /// multiple of eight.
  void Packet(int x, int y, I8 wanted, std::vector<float>* means) const;
  /// Whether all samples that these eight pixels' means could be taken from are 1: then so are
  /// these. May say no though they are.
  bool OnesAround(int x, int y) const;

 private:
  /// Whether all pixels that Packet reads around its own lie in the image.
  bool Inside(int x, int y) const;
  bool SameSurface(std::size_t i, std::size_t j) const;
  float Mean(int x, int y) const;
  F8 Mean8(std::size_t i) const;
  F8x3 Normals(I8 primitive, I8 valid) const;

  const HitImage& image_;
  std::span<const SurfaceRecord> statics_;
  std::span<const float> raw_;
};

}  // namespace aisle::sim
