#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "simulator/shade/light/static_light.h"
#include "simulator/shade/pass/frame_light.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {

struct ShadeOptions {
  StaticLightOptions statics;
  float mover_texel_m = 0.08f;  ///< spacing of light on large faces of movers
  bool antialias = true;        ///< extra rays where neighbouring pixels see different things
  bool gloss = true;            ///< glossy static surfaces mirror what is around them
  bool mover_shadows = true;    ///< movers block direct and indirect light from the static world
};

/// Turns hits into light: the static world reads its solved light, movers are lit by shadow rays,
/// and what movers take away is traced where it can matter.
class Shader {
 public:
  /// Solves the static world's light: seconds for a hall.
  Shader(const World& world, const Tracer& tracer, const ShadeOptions& options);
  ~Shader();

  const StaticLight& static_light() const { return static_light_; }
  /// Radiance by pixel of each view, CV_32F, in the units of the lights. `images` are the hits of
  /// the same views. `lap`, if any, is called with a stage's name at its end. Thread-safe.
  std::vector<cv::Mat1f> Shade(const Instant& instant, std::span<const CameraView> views,
                               std::span<const HitImage> images,
                               const std::function<void(const char*)>& lap = {}) const;

 private:
  struct Workspace;

  ShadeOptions options_;
  TexturePool textures_;
  StaticLight static_light_;
  SurfaceTables tables_;
  mutable std::mutex mutex_;  ///< guards idle_
  mutable std::vector<std::unique_ptr<Workspace>> idle_;
};

}  // namespace aisle::sim
