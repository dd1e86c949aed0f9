#pragma once

#include <span>
#include <vector>

#include "simulator/shade/surface_table.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

/// Means over the 4 × 4 pattern of sample positions around each pixel, of pixels that show the same
/// static surface: what was sampled with one ray a pixel becomes sixteen.
class PatternFilter {
 public:
  /// `raw` has a value per pixel of the image, rows as there; all three must outlive the filter.
  PatternFilter(const HitImage& image, std::span<const SurfaceRecord> statics,
                std::span<const float> raw)
      : image_(image), statics_(statics), raw_(raw) {}

  /// Writes the means (not below 0) of the pixels (x, y) to (x + 7, y) that show the static world;
  /// x is a multiple of eight.
  void Packet(int x, int y, std::vector<float>* means) const;

 private:
  bool SameSurface(std::size_t i, std::size_t j) const;
  float Mean(int x, int y) const;
  F8 Mean8(std::size_t i) const;
  F8x3 Normals(I8 primitive, I8 valid) const;

  const HitImage& image_;
  std::span<const SurfaceRecord> statics_;
  std::span<const float> raw_;
};

}  // namespace aisle::sim
