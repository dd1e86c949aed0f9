#pragma once

#include <opencv2/core.hpp>

#include "simulator/trace/hit_image.h"
#include "simulator/truth/moving_now.h"
#include "simulator/world/world.h"

namespace aisle::sim {

struct MovingShadowOptions {
  /// A pixel is in a moving shadow where moving surfaces keep away more than this share of the
  /// light that luminaires, spots and the sun would send it straight through all that rests.
  float share = 0.05f;
};

/// 255 where the pixel's surface itself rests, but something that moves now stands between it and a
/// luminaire or moving light: brightness there changes though nothing seen does. What rests keeps
/// its light away whether it may move or not: behind a parked truck nobody casts a shadow. Each
/// luminaire is sampled at four points of its area, beams have their cones and windows; direct
/// light only, by the cosines and the distance, whatever the material. A beam that turns is no
/// shadow. Needs no shading and changes with no shading option.
cv::Mat1b FindMovingShadows(const World& world, const Instant& instant, const CameraView& view,
                            const HitImage& hits, const MovingNow& moving,
                            const MovingShadowOptions& options = {});

}  // namespace aisle::sim
