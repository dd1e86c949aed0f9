#pragma once

#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Stereo points nearer than so many baselines, by whether the pose has used them.
struct ClosePoints {
  int tracked = 0, untracked = 0;
};
ClosePoints CountClosePoints(const Frame& frame, const FramePose& pose, const StereoCamera& camera,
                             double close_baselines);

}  // namespace aisle::slam
