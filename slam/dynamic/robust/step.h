#pragma once

#include <opencv2/core.hpp>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/robust/disparity_tolerance.h"
#include "slam/dynamic/robust/robust_options.h"
#include "slam/dynamic/robust/robust_state.h"
#include "slam/dynamic/robust/view.h"

namespace aisle::slam::dynamic {

/// One step of the method: what it knew, the frame that has come, and what the two are compared by.
struct Step {
  const RobustState& before;
  const View& view;
  cv::Size image;              ///< pixels of the left image, full size
  const StereoCamera& camera;  ///< of the full size
  const StereoCamera& half;    ///< the same at half size, as the view is
  const DisparityTolerance& tolerance;
  const RobustOptions& options;
};

}  // namespace aisle::slam::dynamic
