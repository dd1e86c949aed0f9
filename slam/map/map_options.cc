#include "slam/map/map_options.h"

#include "slam/map/align_patch.h"

namespace aisle::slam {

void Describe(OptionFields& fields, MatchOptions& options) {
  fields.Number(
      "radius_px", &options.radius_px, {0, 500}, "px",
      "Search radius around a landmark's predicted pixel, in pixels of its predicted level.");
  fields.Integer("descriptor_distance", &options.descriptor_distance, {0, 256}, "bits",
                 "Features whose descriptors differ by more do not match.");
  fields.Number("ratio", &options.ratio, {0, 1}, "",
                "A match's distance is at most this share of the second best's.");
}

void Describe(OptionFields& fields, PatchOptions& options) {
  fields.Integer("radius_px", &options.radius_px, {0, kLargestPatchRadius}, "px",
                 "Reach of the square by which a landmark is found to a fraction of a pixel, in "
                 "pixels of the level; 0: corners stay where they were found.");
  fields.Integer(
      "iterations", &options.iterations, {1, 100}, "",
      "Most steps of the alignment; a patch that has not settled by then is not aligned.");
  fields.Number("most_shift_px", &options.most_shift_px, {0.1, 6}, "px",
                "Largest distance of a landmark from its corner, in pixels of the level.");
  fields.Number("most_scale", &options.most_scale, {1, 2}, "",
                "Largest ratio in pixel size of two patches that are compared.");
  fields.Number("least_correlation", &options.least_correlation, {0, 1}, "",
                "Least correlation of two patches that show the same.");
  fields.Number("image_noise", &options.image_noise, {0.01, 100}, "grey levels",
                "Deviation of one pixel's brightness.");
  fields.Number("noise_share", &options.noise_share, {0, 1}, "",
                "Share of a corner's deviation that remains once its patch is aligned, however "
                "good the texture.");
}

void Describe(OptionFields& fields, CreateLandmarksOptions& options) {
  fields.Number("worst_depth_ratio", &options.worst_depth_ratio, {1e-3, 1}, "",
                "A stereo point becomes a landmark where its depth's deviation is below this share "
                "of the depth.");
  fields.Integer("least", &options.least, {0, 10000}, "landmarks",
                 "A keyframe with fewer landmarks takes the best of its poorer points as well.");
  fields.Number("worst_depth_ratio_then", &options.worst_depth_ratio_then, {1e-3, 1}, "",
                "Largest deviation of depth over depth of these poorer points.");
}

void Describe(OptionFields& fields, TriangulateOptions& options) {
  fields.Integer("neighbours", &options.neighbours, {0, 100}, "keyframes",
                 "Keyframes that a new one is compared with, most covisible first; 0: none.");
  fields.Integer("descriptor_distance", &options.descriptor_distance, {0, 256}, "bits",
                 "Features whose descriptors differ by more do not match.");
  fields.Number(
      "descriptor_ratio", &options.descriptor_ratio, {0, 1}, "",
      "A match's distance is at most this share of the second best's on the epipolar line.");
  fields.Number("worst_depth_ratio", &options.worst_depth_ratio, {1e-3, 1}, "",
                "Points whose depth's deviation is above this share of the depth are left out.");
}

void Describe(OptionFields& fields, CullOptions& options) {
  fields.Number("least_found_ratio", &options.least_found_ratio, {0, 1}, "",
                "A landmark that is found in fewer than this share of the frames that should see "
                "it is removed.");
  fields.Integer("probation_keyframes", &options.probation_keyframes, {0, 10000}, "keyframes",
                 "Number of further keyframes after which a landmark must be confirmed.");
  fields.Integer(
      "least_weight", &options.least_weight, {0, 1000}, "",
      "Least number of observations of a confirmed landmark; those with depth count twice.");
  fields.Number(
      "redundant_share", &options.redundant_share, {0, 1}, "",
      "A keyframe is removed when more than this share of its landmarks is seen elsewhere.");
  fields.Integer(
      "redundant_observers", &options.redundant_observers, {1, 1000}, "keyframes",
      "Number of other keyframes that must see a landmark as sharply for it to be seen elsewhere.");
  fields.Integer("recent_keyframes", &options.recent_keyframes, {0, 10000}, "keyframes",
                 "Number of the newest keyframes that are never culled.");
}

void Describe(OptionFields& fields, FuseOptions& options) {
  fields.Integer("neighbours", &options.neighbours, {0, 1000}, "keyframes",
                 "Keyframes that a new one exchanges landmarks with, most covisible first.");
  fields.Integer("least_shared", &options.least_shared, {1, 10000}, "landmarks",
                 "Least number of shared landmarks that makes two keyframes neighbours.");
  fields.Number(
      "radius_px", &options.radius_px, {0, 500}, "px",
      "Search radius around a landmark's predicted pixel, in pixels of its predicted level.");
  fields.Integer("descriptor_distance", &options.descriptor_distance, {0, 256}, "bits",
                 "Features whose descriptors differ by more do not match.");
}

}  // namespace aisle::slam
