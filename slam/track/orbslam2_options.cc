#include "slam/track/orbslam2_options.h"

namespace aisle::slam {
namespace {

void DescribeFirstPose(OptionFields& fields, OrbSlam2Options& options) {
  fields.Integer("first_features", &options.first_features, {10, 10000}, "",
                 "A frame that starts a map has more features than this.");
  fields.Number("motion_radius_px", &options.motion_radius_px, {0, 500}, "px",
                "Search radius around the position of a point of the last frame that the previous "
                "motion predicts, in pixels of its level.");
  fields.Integer("motion_distance", &options.motion_distance, {0, 256}, "bits",
                 "Largest descriptor distance of matches to the last frame.");
  fields.Integer(
      "least_motion_matches", &options.least_motion_matches, {0, 10000}, "",
      "With fewer matches to the last frame the search is repeated twice as wide, then abandoned.");
  fields.Integer("reference_distance", &options.reference_distance, {0, 256}, "bits",
                 "Largest descriptor distance of matches to the reference keyframe's points.");
  fields.Number(
      "reference_ratio", &options.reference_ratio, {0, 1}, "",
      "Largest distance of matches to the reference keyframe, as a share of the second best's.");
  fields.Integer("least_reference_matches", &options.least_reference_matches, {0, 10000}, "",
                 "With fewer matches to the reference keyframe the frame is lost.");
  fields.Integer("least_first_inliers", &options.least_first_inliers, {3, 10000}, "",
                 "With fewer inliers a first pose has failed.");
}

void DescribeLocalMap(OptionFields& fields, OrbSlam2Options& options) {
  fields.Number("ahead_radius_px", &options.ahead_radius_px, {0, 500}, "px",
                "Search radius for points of the map that are seen at nearly their mean angle, in "
                "pixels of the predicted level.");
  fields.Number("ahead_cosine", &options.ahead_cosine, {0, 1}, "",
                "Cosine of the angle from its mean direction within which a point is seen at "
                "nearly its mean angle.");
  fields.Number("aside_radius_px", &options.aside_radius_px, {0, 500}, "px",
                "Search radius for the other points of the map, in pixels of the predicted level.");
  fields.Number("found_again_factor", &options.found_again_factor, {1, 100}, "",
                "Factor of both search radii after relocalisation.");
  fields.Integer("found_again_frames", &options.found_again_frames, {0, 1000}, "frames",
                 "Frames for which that factor holds, the relocalised one included.");
  fields.Integer("map_distance", &options.map_distance, {0, 256}, "bits",
                 "Largest descriptor distance of matches to points of the map.");
  fields.Number("map_ratio", &options.map_ratio, {0, 1}, "",
                "Largest distance of matches to points of the map, as a share of the second best's "
                "on the same level.");
  fields.Integer(
      "local_keyframes", &options.local_keyframes, {1, 1000}, "keyframes",
      "Most keyframes of the local map up to which neighbours of the frame's observers join.");
  fields.Integer("neighbours", &options.neighbours, {0, 1000}, "keyframes",
                 "Most covisible keyframes of an observer, of which one may join.");
  fields.Integer("least_inliers", &options.least_inliers, {3, 10000}, "",
                 "With fewer inliers in the map the frame is lost.");
  fields.Integer("least_inliers_after_loss", &options.least_inliers_after_loss, {3, 10000}, "",
                 "With fewer inliers in the map the frame is lost, shortly after relocalisation.");
  fields.Number("settles_s", &options.settles_s, {0, 1e6}, "s",
                "Time for which relocalisation counts as recent.");
}

void DescribeRelocalisation(OptionFields& fields, OrbSlam2Options& options) {
  fields.Number("lost_ratio", &options.lost_ratio, {0, 1}, "",
                "Largest distance of a lost frame's matches, as a share of the second best's.");
  fields.Integer("least_lost_matches", &options.least_lost_matches, {0, 10000}, "",
                 "Keyframes with fewer matches to a lost frame are not tried.");
  fields.Group("align", &options.align);
  fields.Integer("least_found_inliers", &options.least_found_inliers, {3, 10000}, "",
                 "Least number of inliers with which a lost frame is found.");
  fields.Integer("least_narrow_inliers", &options.least_narrow_inliers, {3, 10000}, "",
                 "With more inliers than this, but too few, the last ones are looked for.");
  fields.Number("wide_radius_px", &options.wide_radius_px, {0, 500}, "px",
                "Search radius for more points of the keyframe, in pixels of the predicted level.");
  fields.Integer("wide_distance", &options.wide_distance, {0, 256}, "bits",
                 "Largest descriptor distance of matches to more points of the keyframe.");
  fields.Number("narrow_radius_px", &options.narrow_radius_px, {0, 500}, "px",
                "Search radius for the last points, in pixels of the predicted level.");
  fields.Integer("narrow_distance", &options.narrow_distance, {0, 256}, "bits",
                 "Largest descriptor distance of matches to the last points.");
  fields.Integer("least_keyframes_to_keep", &options.least_keyframes_to_keep, {0, 100000},
                 "keyframes", "Most keyframes of a map that is abandoned once it is lost.");
}

void DescribeKeyframes(OptionFields& fields, OrbSlam2Options& options) {
  fields.Number("close_baselines", &options.close_baselines, {0.1, 10000}, "baselines",
                "Depth up to which a stereo point counts as close.");
  fields.Integer("few_close", &options.few_close, {0, 100000}, "",
                 "A keyframe is wanted when fewer close points are tracked and there are "
                 "many_new_close other ones.");
  fields.Integer("many_new_close", &options.many_new_close, {0, 100000}, "",
                 "Number of untracked close points above which a keyframe is made.");
  fields.Number("tracked_share", &options.tracked_share, {0, 1}, "",
                "A keyframe is wanted below this share of the reference keyframe's points.");
  fields.Number("tracked_share_at_first", &options.tracked_share_at_first, {0, 1}, "",
                "The same share while there is only one keyframe.");
  fields.Number("alarming_share", &options.alarming_share, {0, 1}, "",
                "A keyframe is wanted below this share even though the mapper is at work.");
  fields.Integer("least_keyframe_inliers", &options.least_keyframe_inliers, {0, 10000}, "",
                 "Least number of inliers of a keyframe.");
  fields.Number(
      "longest_s", &options.longest_s, {0, 1e6}, "s",
      "Time since the last keyframe after which one is wanted even though the mapper is at work.");
  fields.Integer("most_waiting", &options.most_waiting, {0, 1000}, "keyframes",
                 "Number of keyframes waiting for the mapper at which no other joins them.");
  fields.Integer("most_unsettled", &options.most_unsettled, {0, 100000}, "keyframes",
                 "A map with more keyframes takes none shortly after relocalisation.");
  fields.Integer("proven_weight", &options.proven_weight, {0, 1000}, "",
                 "Observations of a reference point that counts; those with depth count twice.");
  fields.Integer(
      "nearest_points", &options.nearest_points, {0, 100000}, "",
      "Nearest stereo points of a keyframe that become landmarks, whatever their depth.");
}

}  // namespace

void Describe(OptionFields& fields, OrbSlam2Options& options) {
  DescribeFirstPose(fields, options);
  DescribeLocalMap(fields, options);
  DescribeRelocalisation(fields, options);
  DescribeKeyframes(fields, options);
}

}  // namespace aisle::slam
