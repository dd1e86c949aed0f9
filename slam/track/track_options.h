#pragma once

#include <string>

#include "slam/map/match_by_projection.h"
#include "slam/optimize/align_points.h"

namespace aisle::slam {

/// How a frame finds its pose in the map.
struct TrackOptions {
  MatchOptions motion{7, 100, 0.9};     ///< landmarks of the last frame, where motion predicts them
  double wide_factor = 3;               ///< widens that search when it finds too little
  MatchOptions local_map{3, 100, 0.8};  ///< the other landmarks around
  int keyframe_distance = 50;           ///< bits; matches to a keyframe without any prediction
  double keyframe_ratio = 0.75;         ///< best to second best of those
  AlignPointsOptions align;             ///< the pose from those
  int least_motion_matches = 20;        ///< fewer: prediction has failed
  int least_inliers = 10;               ///< of a first estimate; fewer: it has failed
  int least_map_inliers = 30;           ///< of the final estimate; fewer: lost
  /// Of the landmarks that should be seen: a pose that explains fewer is doubted, and the other
  /// ways to find one are tried.
  double convincing_share = 0.25;
  int local_keyframes = 20;    ///< whose landmarks are looked for
  double longest_gap_s = 1.0;  ///< motion is not predicted across longer gaps
};

/// When a frame becomes a keyframe.
struct KeyframeOptions {
  double tracked_share = 0.75;   ///< of the reference keyframe's landmarks; below: new keyframe
  double alarming_share = 0.25;  ///< below: new keyframe, however little time has passed
  int least_inliers = 15;        ///< a worse frame is no keyframe
  double close_baselines = 40;   ///< depth up to which a stereo point counts as close
  int few_close = 100;           ///< tracked close points below this ...
  int many_new_close = 70;       ///< ... with more untracked than this: new keyframe
  double least_motion = 0.01;    ///< translation over median depth ...
  double least_turn_deg = 1.0;   ///< ... or turn since the reference keyframe: no flood at rest
};

}  // namespace aisle::slam
