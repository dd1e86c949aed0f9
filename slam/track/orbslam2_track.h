#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "slam/map/match_by_projection.h"
#include "slam/track/orbslam2_options.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// What ORB-SLAM2's tracking keeps of the last frame.
struct OrbSlam2Memory {
  std::shared_ptr<const Frame> frame;
  std::vector<Match> matches;  ///< its landmarks, those that it has made as a keyframe included
  std::optional<Eigen::Isometry3d> T_now_before;  ///< as the rig has moved to it
  int frames_since_found = 1;                     ///< again after a loss, or since the drive began
  double seconds_since_found = 0;                 ///< likewise
};

using OrbSlam2Context = TrackingContext<OrbSlam2Options>;

/// Finds the frame as ORB-SLAM2 does: from the last frame's landmarks where its motion leads,
/// whatever that motion is; failing that, or for want of a motion, by the looks of the reference
/// keyframe from where the last frame was; then with all landmarks around. A pose is believed for
/// its inliers alone. Nothing if lost.
std::optional<FramePose> OrbSlam2Track(const OrbSlam2Context& context,
                                       const Eigen::Isometry3d& T_world_last, KeyframeId reference,
                                       const OrbSlam2Memory& memory);

/// Finds a lost frame by the looks of `candidates`, most alike first: three points make a pose,
/// which must gather enough inliers, if need be by searching around. Then as above.
std::optional<FramePose> OrbSlam2Relocalise(const OrbSlam2Context& context,
                                            const std::vector<KeyframeId>& candidates);

}  // namespace aisle::slam
