#include "slam/mapping/orbslam2_mapping_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, OrbSlam2MappingOptions& options) {
  fields.Number("close_baselines", &options.close_baselines, {0.1, 10000}, "baselines",
                "Depth up to which a stereo point of a keyframe counts as close.");
  fields.Number(
      "least_ray_sine", &options.least_ray_sine, {1e-4, 1}, "",
      "Sine of the angle between two rays below which they place no point without depth.");
  fields.Integer(
      "second_neighbours", &options.second_neighbours, {0, 1000}, "keyframes",
      "Most covisible keyframes of each neighbour with which landmarks are exchanged too.");
  fields.Number("least_found_ratio", &options.least_found_ratio, {0, 1}, "",
                "A new landmark that is found in fewer than this share of the frames that should "
                "see it is removed.");
  fields.Integer("confirmed_after", &options.confirmed_after, {0, 10000}, "keyframes",
                 "Number of further keyframes after which a new landmark must be confirmed.");
  fields.Integer(
      "least_confirmed_weight", &options.least_confirmed_weight, {0, 1000}, "",
      "Least number of observations of a confirmed landmark; those with depth count twice.");
  fields.Integer("probation", &options.probation, {0, 10000}, "keyframes",
                 "Number of keyframes for which a landmark is new.");
  fields.Integer(
      "least_weight", &options.least_weight, {0, 1000}, "",
      "Least number of observations of a landmark that loses one; those with depth count twice.");
  fields.Number(
      "redundant_share", &options.redundant_share, {0, 1}, "",
      "A keyframe is removed when more than this share of its close landmarks is seen elsewhere.");
  fields.Integer(
      "redundant_observers", &options.redundant_observers, {1, 1000}, "keyframes",
      "Number of other keyframes that must see a landmark as sharply for it to be seen elsewhere.");
  fields.Integer("points_after_frames", &options.points_after_frames, {1, 1e6}, "frames",
                 "Frames from a keyframe to its new landmarks; never after the adjustment, which "
                 "comes at schedule.mapping_frames.");
}

}  // namespace aisle::slam
