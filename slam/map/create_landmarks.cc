#include "slam/map/create_landmarks.h"

#include <algorithm>
#include <limits>

namespace aisle::slam {
namespace {

/// Deviation of a stereo point's depth over the depth; infinite without one. The depth is f b / d,
/// so it is the disparity's.
double DepthRatio(const Measurement& measurement) {
  const bool has_depth = measurement.has_depth() && measurement.uvd.z() > 0;
  return has_depth ? DisparitySigma(measurement) / measurement.uvd.z()
                   : std::numeric_limits<double>::infinity();
}

/// The features that become landmarks, rising.
std::vector<int> ChooseFeatures(const Keyframe& keyframe, const CreateLandmarksOptions& options) {
  std::vector<std::pair<double, int>> free;  // depth ratio, feature
  int landmarks = 0;                         // that are there, and chosen
  for (int i = 0; i < std::ssize(keyframe.landmarks); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (keyframe.landmarks[at].valid()) {
      ++landmarks;
    } else {
      free.push_back({DepthRatio(keyframe.frame->measurements[at]), i});
    }
  }
  std::sort(free.begin(), free.end());
  std::vector<int> chosen;
  for (const auto& [ratio, feature] : free) {
    const bool is_needed = landmarks < options.least && ratio < options.worst_depth_ratio_then;
    if (ratio >= options.worst_depth_ratio && !is_needed) break;
    chosen.push_back(feature);
    ++landmarks;
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

std::vector<Landmark> CreateLandmarks(const Keyframe& keyframe, const StereoCamera& camera,
                                      const CreateLandmarksOptions& options) {
  std::vector<Landmark> landmarks;
  for (const int feature : ChooseFeatures(keyframe, options)) {
    const auto at = static_cast<std::size_t>(feature);
    Landmark landmark;
    landmark.position =
        keyframe.T_world_rig * Backproject(camera, keyframe.frame->measurements[at].uvd);
    landmark.observations = {{keyframe.id, feature}};
    landmark.created_by = keyframe.id;
    landmark.predicted = landmark.found = 1;
    landmarks.push_back(landmark);
  }
  return landmarks;
}

}  // namespace aisle::slam
