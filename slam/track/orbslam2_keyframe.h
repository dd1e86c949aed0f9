#pragma once

#include "slam/track/orbslam2_options.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// What ORB-SLAM2's keyframe rule asks of the drive, besides the frame.
struct OrbSlam2Drive {
  double seconds_since_keyframe = 0;
  double seconds_since_found = 0;  ///< again after a loss, or since the drive began
  bool mapper_idle = true;
  int waiting = 0;  ///< keyframes that wait for the mapper
};

/// What the rule says of a frame.
struct OrbSlam2Verdict {
  bool wanted = false;  ///< a mapper at work shall hurry
  bool taken = false;   ///< nothing hinders it
};

/// Whether a tracked frame becomes a keyframe: it sees clearly less of the map than its reference
/// keyframe or needs close points, and the mapper is idle, or it is urgent, or a second has passed.
/// Whether the rig has moved is not asked.
OrbSlam2Verdict OrbSlam2NeedsKeyframe(const Map& map, const Frame& frame, const FramePose& pose,
                                      const StereoCamera& camera, const OrbSlam2Drive& drive,
                                      const OrbSlam2Options& options);

/// The keyframe that a tracked frame becomes: it sees the landmarks that the pose kept, and its
/// other close stereo points become landmarks at once, the nearest ones first, farther ones too
/// until `nearest_points` are landmarks.
MapEdit OrbSlam2Keyframe(const Map& map, const std::shared_ptr<const Frame>& frame,
                         const FramePose& pose, const StereoCamera& camera,
                         const OrbSlam2Options& options);

/// The keyframe that starts a map, in the world's origin, with a landmark for every stereo point;
/// nothing where the frame has too few features.
std::optional<MapEdit> OrbSlam2FirstKeyframe(const std::shared_ptr<const Frame>& frame,
                                             const StereoCamera& camera,
                                             const OrbSlam2Options& options);

}  // namespace aisle::slam
