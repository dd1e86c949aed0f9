#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/map/map_options.h"

namespace aisle::slam {

/// Landmarks for the features of `keyframe` that have good depth and name none yet, by rising
/// feature; where these and the landmarks that it names are fewer than `least`, for some of poorer
/// depth as well.
std::vector<Landmark> CreateLandmarks(const Keyframe& keyframe, const StereoCamera& camera,
                                      const CreateLandmarksOptions& options);

}  // namespace aisle::slam
