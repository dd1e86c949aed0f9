#pragma once

#include <optional>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/map/match_by_projection.h"
#include "slam/optimize/refine_pose.h"

namespace aisle::slam {

/// A place seen again, once both visits have had their say.
struct AdjustedView {
  Eigen::Isometry3d T_rig_world = Eigen::Isometry3d::Identity();
  int inliers = 0;  ///< matches that agree with it
};

/// The pose of a frame that sees old landmarks (`matches`, those with `inlier`), adjusted together
/// with the landmarks: the old keyframes hold still, and their observations and the new ones share
/// the error by the noise they state. A pose against landmarks held fixed would inherit the depth
/// error of the one stereo pair that placed them. Nothing where the adjustment is numerically
/// unsound.
std::optional<AdjustedView> AdjustView(const Map& map, const Frame& frame,
                                       const std::vector<Match>& matches,
                                       const std::vector<bool>& inlier,
                                       const Eigen::Isometry3d& T_rig_world,
                                       const StereoCamera& camera);

}  // namespace aisle::slam
