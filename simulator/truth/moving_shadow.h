#pragma once

#include <opencv2/core.hpp>

#include "simulator/trace/hit_image.h"
#include "simulator/truth/moving_now.h"
#include "simulator/world/world.h"

namespace aisle::sim {

struct MovingShadowOptions {
  /// A pixel is in a moving shadow where moving surfaces keep away more than this share of the
  /// light that luminaires would send it straight through the static world.
  float share = 0.05f;
};

/// 255 where the pixel's surface itself rests, but something that moves now stands between it and a
/// luminaire: brightness there changes though nothing seen does. Each luminaire is sampled at four
/// points of its area; direct light only, by the cosines and the distance, whatever the material.
/// Needs no shading and changes with no shading option.
cv::Mat1b FindMovingShadows(const World& world, const Instant& instant, const CameraView& view,
                            const HitImage& hits, const MovingNow& moving,
                            const MovingShadowOptions& options = {});

}  // namespace aisle::sim
