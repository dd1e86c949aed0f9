#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/optimize/bundle.h"

namespace aisle::slam {

struct LocalAdjustmentOptions {
  int free_keyframes = 12;    ///< the keyframe and its most covisible ones
  int fixed_keyframes = 20;   ///< others that see the same landmarks, most shared first
  int least_shared = 15;      ///< landmarks; fewer make no neighbours
  int robust_iterations = 4;  ///< first pass
  int final_iterations = 6;   ///< second pass, without outliers
};

/// What an adjustment asks of the map.
struct Adjustment {
  MapEdit edit;  ///< poses, positions, and cuts of outliers
  BundleSummary summary;
};

/// Adjusts the surroundings of a keyframe; keyframes further out hold them in place. Outliers are
/// told apart after a robust pass, tested again after the final one, and cut.
Adjustment AdjustLocally(const Map& map, KeyframeId around, const StereoCamera& camera,
                         const LocalAdjustmentOptions& options);

}  // namespace aisle::slam
