#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/common/option_fields.h"
#include "slam/map/map.h"

namespace aisle::slam {

struct CreateLandmarksOptions {
  /// A stereo point becomes a landmark where its depth is known this well (deviation over depth).
  double worst_depth_ratio = 0.1;
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, CreateLandmarksOptions& options);

/// Whether a measurement places a point well enough to be a landmark on its own.
bool PlacesPoint(const Measurement& measurement, const CreateLandmarksOptions& options);

/// Landmarks for the features of `keyframe` that have good depth and name none yet.
std::vector<Landmark> CreateLandmarks(const Keyframe& keyframe, const StereoCamera& camera,
                                      const CreateLandmarksOptions& options);

}  // namespace aisle::slam
