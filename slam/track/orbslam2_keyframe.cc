#include "slam/track/orbslam2_keyframe.h"

#include <algorithm>

#include "slam/track/close_points.h"

namespace aisle::slam {
namespace {

/// Landmarks of the reference keyframe that enough observations have confirmed.
int ConfirmedLandmarks(const Map& map, KeyframeId reference, const OrbSlam2Options& options) {
  const int young = map.keyframes().size() <= 2 ? 1 : 0;  // a young map cannot ask for as much
  const Keyframe& keyframe = map.At(reference);
  return static_cast<int>(std::ranges::count_if(keyframe.landmarks, [&](LandmarkId id) {
    const Landmark* landmark = map.Find(id);
    return landmark && ObservationWeight(map, *landmark) >= options.proven_weight - young;
  }));
}

Landmark NewLandmark(const Keyframe& keyframe, int feature, const StereoCamera& camera) {
  const Measurement& measurement = keyframe.frame->measurements[static_cast<std::size_t>(feature)];
  Landmark landmark;
  landmark.position = keyframe.T_world_rig * Backproject(camera, measurement.uvd);
  landmark.observations = {{keyframe.id, feature}};
  landmark.created_by = keyframe.id;
  landmark.predicted = landmark.found = 1;
  return landmark;
}

/// Features with depth, nearest first.
std::vector<int> ByDepth(const Frame& frame) {
  std::vector<int> features;
  for (int i = 0; i < frame.size(); ++i) {
    if (frame.measurements[static_cast<std::size_t>(i)].has_depth()) features.push_back(i);
  }
  std::ranges::stable_sort(features, std::greater<>(), [&](int i) {
    return frame.measurements[static_cast<std::size_t>(i)].uvd.z();
  });
  return features;
}

}  // namespace

OrbSlam2Verdict OrbSlam2NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                                      const StereoCamera& camera, const OrbSlam2Drive& drive,
                                      const OrbSlam2Options& options) {
  const auto keyframes = std::ssize(map.keyframes());
  if (drive.seconds_since_found < options.settles_s && keyframes > options.most_unsettled) {
    return {};
  }

  const ClosePoints close = CountClosePoints(frame, pose, camera, options.close_baselines);
  const bool lacks_close =
      close.tracked < options.few_close && close.untracked > options.many_new_close;
  const int inliers = pose.pose.inliers;
  const int confirmed = ConfirmedLandmarks(map, pose.local.reference, options);
  const double share = keyframes < 2 ? options.tracked_share_at_first : options.tracked_share;

  const bool useful =
      (inliers < share * confirmed || lacks_close) && inliers > options.least_keyframe_inliers;
  const bool urgent = inliers < options.alarming_share * confirmed || lacks_close;
  const bool late = drive.seconds_since_keyframe >= options.longest_s;
  const bool wanted = useful && (drive.mapper_idle || urgent || late);
  return {wanted, wanted && (drive.mapper_idle || drive.waiting < options.most_waiting)};
}

MapEdit OrbSlam2Keyframe(const Map& map, const std::shared_ptr<const Frame>& frame,
                         const FramePose& pose, const StereoCamera& camera,
                         const OrbSlam2Options& options) {
  Keyframe keyframe = KeyframeOf(map, frame, pose);
  MapEdit edit;
  const double least_disparity = camera.fx / options.close_baselines;
  int points = 0;  // of the nearest that are landmarks by now
  for (const int feature : ByDepth(*frame)) {
    const auto i = static_cast<std::size_t>(feature);
    if (!keyframe.landmarks[i].valid()) {
      edit.new_landmarks.push_back(NewLandmark(keyframe, feature, camera));
    }
    ++points;
    if (frame->measurements[i].uvd.z() < least_disparity && points > options.nearest_points) break;
  }
  edit.new_keyframes = {std::move(keyframe)};
  return edit;
}

std::optional<MapEdit> OrbSlam2FirstKeyframe(const std::shared_ptr<const Frame>& frame,
                                             const StereoCamera& camera,
                                             const OrbSlam2Options& options) {
  if (frame->size() <= options.first_features) return std::nullopt;
  Keyframe keyframe;
  keyframe.id = {0};
  keyframe.frame = frame;
  keyframe.landmarks.resize(static_cast<std::size_t>(frame->size()));
  MapEdit edit;
  for (int i = 0; i < frame->size(); ++i) {
    if (!frame->measurements[static_cast<std::size_t>(i)].has_depth()) continue;
    edit.new_landmarks.push_back(NewLandmark(keyframe, i, camera));
  }
  edit.new_keyframes = {std::move(keyframe)};
  return edit;
}

}  // namespace aisle::slam
