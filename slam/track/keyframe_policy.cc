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

/// T_reference_rig.
Eigen::Isometry3d MotionFrom(const Keyframe& reference, const FramePose& pose) {
  return (pose.pose.T_rig_world * reference.T_world_rig).inverse();
}

bool HasMoved(const Eigen::Isometry3d& T_reference_rig, double median_depth_m,
              const KeyframeOptions& options) {
  const double turn_deg =
      Eigen::AngleAxisd(T_reference_rig.linear()).angle() * 180 / std::numbers::pi;
  return T_reference_rig.translation().norm() > options.least_motion * median_depth_m ||
         turn_deg > options.least_turn_deg;
}

}  // namespace

bool NeedsKeyframeAtOnce(const Map& map, const Frame& frame, const FramePose& pose,
                         const StereoCamera& camera, const KeyframeOptions& options) {
  const int inliers = LeftInliers(pose);
  const bool lacks_any = inliers >= options.least_inliers && inliers < options.few_inliers &&
                         StereoPoints(frame) - inliers > options.many_new;
  if (!lacks_any) return false;
  const Keyframe& reference = map.At(pose.local.reference);
  return HasMoved(MotionFrom(reference, pose), MedianDepth(frame, camera), options) ||
         inliers < options.first_tracked_share * ProvenLandmarks(map, reference);
}

bool NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                   const StereoCamera& camera, const KeyframeOptions& options) {
  if (NeedsKeyframeAtOnce(map, frame, pose, camera, options)) return true;
  // What the right camera alone shows does not join the map.
  const int inliers = LeftInliers(pose);
  if (inliers < options.least_inliers) return false;
  const Keyframe& reference = map.At(pose.local.reference);
  if (!HasMoved(MotionFrom(reference, pose), MedianDepth(frame, camera), options)) return false;

  const ClosePoints close = CountClosePoints(frame, pose, camera, options.close_baselines);
  const bool lacks_close =
      close.tracked < options.few_close && close.untracked > options.many_new_close;
  const double share =
      map.keyframes().size() < 2 ? options.first_tracked_share : options.tracked_share;
  return lacks_close || inliers < share * ProvenLandmarks(map, reference);
}

}  // namespace aisle::slam
