#include "slam/track/track_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, DeadReckoningOptions& options) {
  fields.Number("longest_s", &options.longest_s, {0, 60}, "s",
                "Longest time without a pose after which motion still predicts one.");
  fields.Number("half_life_s", &options.half_life_s, {1e-3, 1000}, "s",
                "Half-life over which the previous motion is averaged.");
  fields.Group("match", &options.match);
  fields.Number("radius_growth_px_per_s", &options.radius_growth_px_per_s, {0, 1000}, "px/s",
                "Growth of the search radius with the time without a pose, where the plain radius "
                "finds too little.");
  fields.Group("align", &options.align);
  fields.Integer("least_inliers", &options.least_inliers, {3, 10000}, "",
                 "Least number of inliers of a final estimate.");
  fields.Number("least_share", &options.least_share, {0, 1}, "",
                "Least share of inliers among the landmarks that should be seen.");
  fields.Number("drift_m_per_s", &options.drift_m_per_s, {0, 1000}, "m/s",
                "Largest distance of a pose from the predicted one, per second.");
  fields.Number("drift_deg_per_s", &options.drift_deg_per_s, {0, 1000}, "deg/s",
                "Largest rotation of a pose from the predicted one, per second.");
}

void Describe(OptionFields& fields, InertiaOptions& options) {
  fields.Number("acceleration_mps2", &options.acceleration_mps2, {0.01, 1000}, "m/s^2",
                "Deviation of the acceleration, from frame to frame.");
  fields.Number("angular_acceleration_radps2", &options.angular_acceleration_radps2, {0.01, 1000},
                "rad/s^2", "Deviation of the angular acceleration, from frame to frame.");
  fields.Number("most_chi2", &options.most_chi2, {1, 1e6}, "",
                "Largest difference between a pose and where inertia leads, over the covariance of "
                "the difference.");
  fields.Number(
      "longest_s", &options.longest_s, {0, 1000}, "s",
      "Time for which a rig that sees too little continues as it moved; then it is lost.");
}

void Describe(OptionFields& fields, MeasuredMotionOptions& options) {
  fields.Integer("least_inliers", &options.least_inliers, {3, 10000}, "",
                 "With fewer inliers the frame is placed where the measured motion leads.");
  fields.Number("most_chi2", &options.most_chi2, {1, 1e6}, "",
                "Largest difference between a pose and the measured one, over the covariance of "
                "the difference; beyond it, the pose is that of something that moves.");
  fields.Number(
      "extend_after_s", &options.extend_after_s, {0, 1000}, "s",
      "Time without the map after which a frame continues it where the measured motion leads.");
}

void Describe(OptionFields& fields, LookOptions& options) {
  fields.Number("least_m", &options.least_m, {0, 1000}, "m",
                "Way from which the next frame counts for or against a landmark.");
  fields.Number("least_deg", &options.least_deg, {0, 180}, "deg",
                "Turn from which it counts as well; 0 for both: every frame counts.");
}

void Describe(OptionFields& fields, TrackOptions& options) {
  fields.Group("motion", &options.motion);
  fields.Number("wide_factor", &options.wide_factor, {1, 100}, "",
                "Factor of the search radius in the second attempt, from where the rig was last.");
  fields.Group("local_map", &options.local_map);
  fields.Group("patch", &options.patch);
  fields.Integer("keyframe_distance", &options.keyframe_distance, {0, 256}, "bits",
                 "Largest descriptor distance of matches to a keyframe without any prediction.");
  fields.Number("keyframe_ratio", &options.keyframe_ratio, {0, 1}, "",
                "Largest distance of matches to a keyframe without any prediction, as a share of "
                "the second best's.");
  fields.Group("align", &options.align);
  fields.Integer("least_motion_matches", &options.least_motion_matches, {0, 10000}, "",
                 "With fewer matches the prediction by motion has failed.");
  fields.Integer("least_inliers", &options.least_inliers, {3, 10000}, "",
                 "With fewer inliers a first estimate has failed.");
  fields.Integer("least_map_inliers", &options.least_map_inliers, {3, 10000}, "",
                 "With fewer inliers in the local map the frame is lost.");
  fields.Number(
      "convincing_share", &options.convincing_share, {0, 1}, "",
      "A pose that explains less of the landmarks that should be seen is doubted, and the "
      "other ways to find one are tried.");
  fields.Number("prior_map_share", &options.prior_map_share, {0, 1}, "",
                "A pose on which a smaller share agrees of the landmarks of a loaded map that are "
                "found again is not used; it helps against movers that fill the view.");
  fields.Integer("local_keyframes", &options.local_keyframes, {1, 1000}, "keyframes",
                 "Keyframes of the local map, whose landmarks are looked for.");
  fields.Number("longest_gap_s", &options.longest_gap_s, {0, 60}, "s",
                "Motion is not predicted across longer gaps between frames.");
  fields.Group("dead_reckoning", &options.dead_reckoning);
  fields.Group("inertia", &options.inertia);
  fields.Group("measured", &options.measured);
  fields.Group("look", &options.look);
}

void Describe(OptionFields& fields, KeyframeOptions& options) {
  fields.Number("tracked_share", &options.tracked_share, {0, 1}, "",
                "A frame becomes a keyframe when it tracks less than this share of the reference "
                "keyframe's landmarks.");
  fields.Number("first_tracked_share", &options.first_tracked_share, {0, 1}, "",
                "The same share while the map has only one keyframe, or the rig has not moved.");
  fields.Integer("least_inliers", &options.least_inliers, {3, 10000}, "",
                 "Least number of inliers of a keyframe.");
  fields.Number("close_baselines", &options.close_baselines, {0.1, 10000}, "baselines",
                "Depth up to which a stereo point counts as close.");
  fields.Integer("few_close", &options.few_close, {0, 100000}, "",
                 "A frame becomes a keyframe when it tracks fewer close points than this and has "
                 "many_new_close other ones.");
  fields.Integer("many_new_close", &options.many_new_close, {0, 100000}, "",
                 "Number of close points not in the map above which a frame becomes a keyframe.");
  fields.Integer(
      "few_inliers", &options.few_inliers, {0, 100000}, "",
      "A frame becomes a keyframe when it tracks fewer landmarks than this, near or far, "
      "and has many_new other stereo points.");
  fields.Integer("many_new", &options.many_new, {0, 100000}, "",
                 "Number of stereo points not in the map above which such a frame becomes a "
                 "keyframe.");
  fields.Number(
      "least_motion", &options.least_motion, {0, 10}, "",
      "Translation since the reference keyframe, over the median depth, below which there "
      "is no keyframe unless the rig has turned.");
  fields.Number("least_turn_deg", &options.least_turn_deg, {0, 180}, "deg",
                "Turn since the reference keyframe below which there is no keyframe unless the rig "
                "has gone on.");
}

}  // namespace aisle::slam
