#include "slam/place/place_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, LoopOptions& options) {
  fields.Integer("candidates", &options.candidates, {1, 1000}, "keyframes",
                 "Keyframes that are matched with a new one, most alike first.");
  fields.Integer("recent_keyframes", &options.recent_keyframes, {0, 100000}, "keyframes",
                 "Number of the newest keyframes that are not considered as loops.");
  fields.Number("similarity_ratio", &options.similarity_ratio, {0, 1}, "",
                "A candidate's bag-of-words similarity is at least this share of that of the least "
                "similar covisible keyframe.");
  fields.Integer("descriptor_distance", &options.descriptor_distance, {0, 256}, "bits",
                 "Features whose descriptors differ by more do not match.");
  fields.Number("descriptor_ratio", &options.descriptor_ratio, {0, 1}, "",
                "A match's distance is at most this share of the second best's.");
  fields.Group("align", &options.align);
  fields.Integer("least_inliers", &options.least_inliers, {3, 10000}, "landmarks",
                 "Least number of landmarks of the old place that the new view must confirm.");
  fields.Number(
      "radius_px", &options.radius_px, {0, 500}, "px",
      "Search radius for the landmarks of the old place, in pixels of the predicted level.");
  fields.Integer("consistent_loops", &options.consistent_loops, {1, 100}, "loops",
                 "Number of loops that must agree on a correction before it is made.");
  fields.Integer("consistent_inliers", &options.consistent_inliers, {0, 100000}, "landmarks",
                 "Least number of landmarks that these loops must confirm together.");
  fields.Integer("neighbours", &options.neighbours, {0, 1000}, "keyframes",
                 "Number of keyframes before the newest that are asked for the same loop.");
  fields.Integer("neighbour_shared", &options.neighbour_shared, {1, 10000}, "landmarks",
                 "Keyframes that share fewer landmarks with the newest are not asked.");
  fields.Integer("pending_keyframes", &options.pending_keyframes, {0, 100000}, "keyframes",
                 "An unconfirmed loop is forgotten after this many keyframes.");
  fields.Number("consistency_m", &options.consistency_m, {0, 1000}, "m",
                "Translation by which two agreeing corrections may differ.");
  fields.Number("consistency_deg", &options.consistency_deg, {0, 180}, "deg",
                "Rotation by which two agreeing corrections may differ.");
  fields.Number("drift_share", &options.drift_share, {0, 10}, "",
                "Largest correction, drift_m aside, as a share of the path in between.");
  fields.Number("drift_m", &options.drift_m, {0, 1e6}, "m",
                "Translation of a correction that every loop may ask for.");
  fields.Group("spread", &options.spread);
}

}  // namespace aisle::slam
