#pragma once

#include <optional>

#include "slam/camera/measured_motion.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// Where a frame stands by the landmarks of a prior map alone.
struct PoseInPriorMap {
  KeyframeId reference;  ///< the pose is remembered as seen from it
  Eigen::Isometry3d T_reference_rig = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< of a small motion of the rig frame, see Retract
};

/// Finds a frame, of which depths need not be known, around where motion predicts it by those
/// landmarks alone that keyframes before `first_of_drive` have brought: who goes along with the rig
/// was not there when they were mapped, however much of the image shows him, so his features need
/// no mask. Nothing with fewer inliers than TrackOptions::least_map_inliers, or where these are a
/// smaller share of the matches than TrackOptions::prior_map_share.
std::optional<PoseInPriorMap> FindInPriorMap(const PlainContext& context, const TrackMemory& memory,
                                             KeyframeId first_of_drive);

/// T_world_rig, as the map is now.
Eigen::Isometry3d PoseOf(const PoseInPriorMap& found, const Map& map);

/// How the rig has moved between two frames that were found so; nothing where that is further from
/// what is `expected`, if anything is, than InertiaOptions::most_chi2: a camera that repeats a
/// picture shows the rig where it was. Landmarks that both see from much the same place are off
/// alike, so the motion is better known than the covariance says.
std::optional<MeasuredMotion> MotionInPriorMap(const Map& map, const PoseInPriorMap& before,
                                               const PoseInPriorMap& now,
                                               const std::optional<MeasuredMotion>& expected,
                                               const InertiaOptions& options);

}  // namespace aisle::slam
