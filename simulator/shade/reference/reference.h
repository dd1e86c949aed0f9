#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "simulator/shade/surface/texture_pool.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

struct ReferenceOptions {
  int samples = 64;  ///< paths a pixel, spread over its area
  int depth = 8;     ///< surfaces a path may touch; 1 shows luminaires alone
  std::uint64_t seed = 1;
};

/// What choosing a light needs to know of it.
struct ReferenceLight {
  Eigen::Vector3f center, normal;
  float area = 0, power = 0;  ///< m²; area · radiance
  float extent2 = 0;          ///< m², square of its size
};

/// Radiance by unbiased path tracing: diffuse and glossy surfaces (gloss.h), each vertex joined to
/// a random point of a luminaire (next-event estimation), combined with the light that the path
/// itself runs into by the balance heuristic (Veach 1997). Slow; it is what the nightly light is
/// measured against.
class Reference {
 public:
  Reference(const World& world, const TexturePool& textures);

  cv::Mat1f Render(const Instant& instant, const CameraView& view,
                   const ReferenceOptions& options) const;

 private:
  friend class PathPacket;
  const World& world_;
  const TexturePool& textures_;
  std::vector<ReferenceLight> lights_;
  std::vector<std::int32_t> light_of_triangle_;  ///< of the static mesh; -1: not a luminaire
};

}  // namespace aisle::sim
