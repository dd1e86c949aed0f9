#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/common/option_fields.h"
#include "slam/map/map.h"

namespace aisle::slam {

struct CreateLandmarksOptions {
  /// A stereo point becomes a landmark where its depth is known this well (deviation over depth).
  double worst_depth_ratio = 0.1;
  /// With fewer of those, the best of the others make up the number: far points say little of where
  /// the rig is, but more than nothing.
  int least = 60;
  double worst_depth_ratio_then = 0.5;  ///< of these others
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, CreateLandmarksOptions& options);

/// Landmarks for the features of `keyframe` that have good depth and name none yet, by rising
/// feature; where these and the landmarks that it names are fewer than `least`, for some of poorer
/// depth as well.
std::vector<Landmark> CreateLandmarks(const Keyframe& keyframe, const StereoCamera& camera,
                                      const CreateLandmarksOptions& options);

}  // namespace aisle::slam
