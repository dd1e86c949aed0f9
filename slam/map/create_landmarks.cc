#include "slam/map/create_landmarks.h"

namespace aisle::slam {

bool PlacesPoint(const Measurement& measurement, const CreateLandmarksOptions& options) {
  // depth = f b / d, so its relative deviation is the disparity's.
  return measurement.has_depth() && measurement.uvd.z() > 0 &&
         measurement.sigma_d < options.worst_depth_ratio * measurement.uvd.z();
}

std::vector<Landmark> CreateLandmarks(const Keyframe& keyframe, const StereoCamera& camera,
                                      const CreateLandmarksOptions& options) {
  std::vector<Landmark> landmarks;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const Measurement& measurement = keyframe.frame->measurements[i];
    if (keyframe.landmarks[i].valid() || !PlacesPoint(measurement, options)) continue;
    Landmark landmark;
    landmark.position = keyframe.T_world_rig * Backproject(camera, measurement.uvd);
    landmark.observations = {{keyframe.id, static_cast<int>(i)}};
    landmark.created_by = keyframe.id;
    landmark.predicted = landmark.found = 1;
    landmarks.push_back(landmark);
  }
  return landmarks;
}

}  // namespace aisle::slam
