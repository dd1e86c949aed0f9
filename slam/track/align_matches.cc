#include "slam/track/align_matches.h"

#include "slam/map/align_patch.h"
#include "slam/map/match_by_projection.h"

#include <Eigen/LU>
#include <cmath>

namespace aisle::slam {
namespace {

/// A feature of a frame as something with a size: one of its pixels, in full-image pixels.
struct Sight {
  const Frame& frame;
  std::size_t feature;

  const Keypoint& keypoint() const { return frame.features.keypoints[feature]; }
  const Measurement& measurement() const { return frame.measurements[feature]; }
  double pixel_px() const { return std::pow(frame.scale, keypoint().level); }
  Eigen::Vector2d corner_px() const { return {keypoint().pixel.x, keypoint().pixel.y}; }
};

/// Where a landmark was seen before: by which feature, and where the rig has moved to since.
struct Before {
  Sight sight;
  Eigen::Isometry3d T_now_before;
  Eigen::Vector3d point;  ///< metres, rig frame of then
};

/// The oldest sight of a landmark whose pixels are about as large on it as those of `now`.
std::optional<Before> FindBefore(const PlainContext& context, const Landmark& landmark,
                                 const Eigen::Isometry3d& T_rig_world, const Sight& now) {
  const double depth = (T_rig_world * landmark.position).z();
  const double most = context.options.patch.most_scale;
  for (const Observation& observation : landmark.observations) {
    const Keyframe& keyframe = context.map.At(observation.keyframe);
    if (keyframe.frame->patches.empty()) continue;
    const Sight sight{*keyframe.frame, static_cast<std::size_t>(observation.feature)};
    const Eigen::Vector3d point = keyframe.T_world_rig.inverse(Eigen::Isometry) * landmark.position;
    if (point.z() < kNearestTrusted_m) continue;
    const double ratio = depth * now.pixel_px() / (point.z() * sight.pixel_px());
    if (ratio > most || ratio < 1 / most) continue;
    return Before{sight, T_rig_world * keyframe.T_world_rig, point};
  }
  return std::nullopt;
}

/// How pixels of then map to pixels of now around the landmark, as if it lay on a plane that faced
/// the camera of then.
Eigen::Matrix2d PixelsNowPerBefore(const StereoCamera& camera, const Before& before,
                                   const Sight& now) {
  const Eigen::Vector3d uvd = Project(camera, before.point);
  const Eigen::Vector3d middle = Project(camera, before.T_now_before * before.point);
  Eigen::Matrix2d J;
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::Vector3d beside = uvd;
    beside[axis] += before.sight.pixel_px();
    const Eigen::Vector3d moved = before.T_now_before * Backproject(camera, beside);
    J.col(axis) = (Project(camera, moved) - middle).head<2>() / now.pixel_px();
  }
  return J;
}

/// What the corner measures, found again by its patch; as it is where the patch is not found.
Measurement Align(const PlainContext& context, const Landmark& landmark,
                  const Eigen::Isometry3d& T_rig_world, const Sight& now) {
  Measurement measurement = now.measurement();
  const auto before = FindBefore(context, landmark, T_rig_world, now);
  if (!before) return measurement;
  const Sight& then = before->sight;
  const Eigen::Vector2d before_px =
      (then.measurement().uvd.head<2>() - then.corner_px()) / then.pixel_px();
  const Eigen::Matrix2d J_before_now = PixelsNowPerBefore(context.camera, *before, now).inverse();
  const auto found = AlignPatch(then.frame.patches[then.feature], before_px, J_before_now,
                                now.frame.patches[now.feature], context.options.patch);
  if (!found) return measurement;
  measurement.uvd.head<2>() = now.corner_px() + now.pixel_px() * found->shift_px;
  const double aligned = std::hypot(context.options.patch.noise_share * measurement.sigma_px,
                                    found->sigma_px * now.pixel_px());
  measurement.sigma_px = std::min(measurement.sigma_px, aligned);
  return measurement;
}

}  // namespace

std::vector<Measurement> AlignMatches(const PlainContext& context,
                                      const Eigen::Isometry3d& T_rig_world,
                                      const std::vector<Match>& matches) {
  std::vector<Measurement> measurements;
  measurements.reserve(matches.size());
  for (const Match& match : matches) {
    const Sight now{context.frame, static_cast<std::size_t>(match.feature)};
    const Landmark& landmark = context.map.At(match.landmark);
    const bool seen = !context.frame.patches.empty() &&
                      (T_rig_world * landmark.position).z() >= kNearestTrusted_m;
    measurements.push_back(seen ? Align(context, landmark, T_rig_world, now) : now.measurement());
  }
  return measurements;
}

}  // namespace aisle::slam
