#pragma once

#include "slam/common/option_fields.h"
#include "slam/map/map_options.h"
#include "slam/optimize/optimize_options.h"

namespace aisle::slam {

/// How a frame is looked for that comes after a while without sight: where the motion before leads.
struct DeadReckoningOptions {
  double longest_s = 4.0;                         ///< of such a while
  double half_life_s = 0.4;                       ///< over which the motion before is averaged
  MatchOptions match{7, 80, 0.8};                 ///< landmarks around where that leads
  double radius_growth_px_per_s = 20;             ///< widens that search when it finds too little
  AlignPointsOptions align{.least_inliers = 12};  ///< the pose from those
  int least_inliers = 12;      ///< of the final estimate; so near a prediction fewer convince
  double least_share = 0.1;    ///< they are of the landmarks that should be seen
  double drift_m_per_s = 0.4;  ///< a pose further from the prediction is a mistake
  double drift_deg_per_s = 4;  ///< so is one turned further from it
};

/// What a vehicle's mass says of its motion: it goes on as it went.
struct InertiaOptions {
  /// Deviation of the acceleration, that of a frame independent of the last one's. As an industrial
  /// vehicle brakes and turns in: the larger, the more of a velocity is the last poses' noise.
  double acceleration_mps2 = 1;
  double angular_acceleration_radps2 = 1;
  /// Of the difference between a pose found and the one expected, over its covariance; 99.99 % with
  /// six degrees of freedom. Beyond it the vehicle cannot have got there.
  double most_chi2 = 27.86;
  double longest_s = 1;  ///< for which a pose is believed that nothing but inertia tells of
};

/// How a frame is looked for whose way from the last one is measured, by wheels say.
struct MeasuredMotionOptions {
  /// Of the final estimate: where the rig is is known, so few suffice to know it better.
  int least_inliers = 10;
  /// Of the difference between found and measured pose, over its covariance; 99.9 % with six
  /// degrees of freedom. Beyond it the pose found is that of something that moves.
  double most_chi2 = 22.46;
  /// Without the map for so long, and with enough stereo points to be seen, a frame continues it
  /// where the measurement says that it is.
  double extend_after_s = 0.5;
};

/// How far the rig moves until what it sees is another look at the map: either is enough.
struct LookOptions {
  double least_m = 0.005;
  double least_deg = 0.1;
};

/// How a frame finds its pose in the map.
struct TrackOptions {
  MatchOptions motion{7, 100, 0.9};     ///< landmarks of the last frame, where motion predicts them
  double wide_factor = 3;               ///< widens that search when it finds too little
  MatchOptions local_map{3, 100, 0.8};  ///< the other landmarks around
  PatchOptions patch;                   ///< where exactly those have been met
  int keyframe_distance = 50;           ///< bits; matches to a keyframe without any prediction
  double keyframe_ratio = 0.75;         ///< best to second best of those
  AlignPointsOptions align;             ///< the pose from those
  int least_motion_matches = 20;        ///< fewer: prediction has failed
  int least_inliers = 10;               ///< of a first estimate; fewer: it has failed
  int least_map_inliers = 30;           ///< of the final estimate; fewer: lost
  /// Of the landmarks that should be seen: a pose that explains fewer is doubted, and the other
  /// ways to find one are tried.
  double convincing_share = 0.25;
  /// Of the landmarks of a prior map that are found again: a pose on which fewer agree is not used,
  /// see FindInPriorMap.
  double prior_map_share = 1.0 / 3;
  int local_keyframes = 20;    ///< whose landmarks are looked for
  double longest_gap_s = 1.0;  ///< motion is not predicted across longer gaps
  DeadReckoningOptions dead_reckoning;
  InertiaOptions inertia;
  MeasuredMotionOptions measured;  ///< where a motion is given: see StereoSlam::Track
  LookOptions look;                ///< between frames that count for or against a landmark
};

/// When a frame becomes a keyframe.
struct KeyframeOptions {
  double tracked_share = 0.75;       ///< of the reference keyframe's landmarks; below: new keyframe
  double first_tracked_share = 0.4;  ///< the same of the map's only keyframe, or at rest
  int least_inliers = 15;            ///< a worse frame is no keyframe
  double close_baselines = 40;       ///< depth up to which a stereo point counts as close
  int few_close = 100;               ///< tracked close points below this ...
  int many_new_close = 70;           ///< ... with more untracked than this: new keyframe
  int few_inliers = 100;             ///< so few landmarks in all ...
  int many_new = 70;                 ///< ... with more other stereo points than this: the same
  double least_motion = 0.01;        ///< translation over median depth ...
  double least_turn_deg = 1.0;       ///< ... or turn since the reference keyframe: no flood at rest
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, DeadReckoningOptions& options);
void Describe(OptionFields& fields, InertiaOptions& options);
void Describe(OptionFields& fields, MeasuredMotionOptions& options);
void Describe(OptionFields& fields, LookOptions& options);
void Describe(OptionFields& fields, TrackOptions& options);
void Describe(OptionFields& fields, KeyframeOptions& options);

}  // namespace aisle::slam
