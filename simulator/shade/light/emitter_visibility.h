#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulator/shade/light/emitters.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

/// The share of each emitter that some places see: rows by place, each of Emitters::stride() values
/// in [0, 1], or kBelowHorizon where the emitter lies behind the place's surface.
struct EmitterVisibility {
  static constexpr float kBelowHorizon = -1;

  EmitterVisibility(std::size_t places, std::size_t row_stride)
      : stride(row_stride), values(places * row_stride, 1.0f) {}
  std::span<float> Row(std::size_t place) {
    return std::span(values).subspan(place * stride, stride);
  }
  std::span<const float> Row(std::size_t place) const {
    return std::span(values).subspan(place * stride, stride);
  }

  std::size_t stride;
  std::vector<float> values;
};

/// A place whose view of the emitters is wanted. `id` deals it its points on them, so it must be
/// the same in each frame and differ between neighbours.
struct ShadowedPlace {
  SurfacePoint surface;
  std::uint32_t id = 0;
};

}  // namespace aisle::sim
