#include "slam/track/keyframe_policy.h"

#include <algorithm>
#include <numbers>

#include "slam/common/median.h"
#include "slam/track/close_points.h"

namespace aisle::slam {
namespace {

/// Landmarks of the keyframe that have proven themselves (a young map cannot ask for much).
int ProvenLandmarks(const Map& map, const Keyframe& keyframe) {
  const std::size_t asked = map.keyframes().size() <= 2 ? 1 : 2;
  return static_cast<int>(
      std::count_if(keyframe.landmarks.begin(), keyframe.landmarks.end(), [&](LandmarkId id) {
        const Landmark* landmark = map.Find(id);
        return landmark && landmark->observations.size() >= asked;
      }));
}

int StereoPoints(const Frame& frame) {
  return static_cast<int>(std::count_if(frame.measurements.begin(), frame.measurements.end(),
                                        [](const Measurement& m) { return m.has_depth(); }));
}

double MedianDepth(const Frame& frame, const StereoCamera& camera) {
  std::vector<double> disparities;
  for (const Measurement& measurement : frame.measurements) {
    if (measurement.has_depth()) disparities.push_back(measurement.uvd.z());
  }
  if (disparities.empty()) return 0;
  return DepthOf(camera, std::max(Median(std::move(disparities)), 0.1));
}

bool HasMoved(const Eigen::Isometry3d& T_reference_rig, double median_depth_m,
              const KeyframeOptions& options) {
  const double turn_deg =
      Eigen::AngleAxisd(T_reference_rig.linear()).angle() * 180 / std::numbers::pi;
  return T_reference_rig.translation().norm() > options.least_motion * median_depth_m ||
         turn_deg > options.least_turn_deg;
}

}  // namespace

bool NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                   const StereoCamera& camera, const KeyframeOptions& options) {
  // What the right camera alone shows does not join the map.
  const int inliers = LeftInliers(pose);
  if (inliers < options.least_inliers) return false;
  const Keyframe& reference = map.At(pose.local.reference);
  const Eigen::Isometry3d T_reference_rig =
      (pose.pose.T_rig_world * reference.T_world_rig).inverse();
  if (!HasMoved(T_reference_rig, MedianDepth(frame, camera), options)) return false;

  const ClosePoints close = CountClosePoints(frame, pose, camera, options.close_baselines);
  const bool lacks_close =
      close.tracked < options.few_close && close.untracked > options.many_new_close;
  const double share =
      map.keyframes().size() < 2 ? options.first_tracked_share : options.tracked_share;
  const bool lacks_any =
      inliers < options.few_inliers && StereoPoints(frame) - inliers > options.many_new;
  return lacks_close || lacks_any || inliers < share * ProvenLandmarks(map, reference);
}

}  // namespace aisle::slam
