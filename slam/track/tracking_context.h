#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/feature/mask_margin.h"
#include "slam/map/frame.h"
#include "slam/map/map.h"

namespace aisle::slam {

/// What every step of finding one frame looks at. All must outlive it.
template <typename Options>
struct TrackingContext {
  const Map& map;
  const Frame& frame;
  const StereoCamera& camera;
  int levels;  ///< of the feature pyramid
  const Options& options;
  const Frame* right = nullptr;  ///< what the right camera sees by itself; null: nobody asks it
  const MaskedArea* masked = nullptr;  ///< where the left camera's features are not taken
};

}  // namespace aisle::slam
