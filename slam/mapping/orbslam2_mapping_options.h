#pragma once

#include "slam/common/option_fields.h"

namespace aisle::slam {

/// The constants of the published ORB-SLAM2's mapping, where it decides differently from ours.
struct OrbSlam2MappingOptions {
  double close_baselines = 35;      ///< depth up to which a stereo point counts as close
  double least_ray_sine = 0.02;     ///< between two rays; less places no point without depth
  int second_neighbours = 5;        ///< of each neighbour, to exchange points with
  double least_found_ratio = 0.25;  ///< of a new point, over the frames that should have seen it
  int confirmed_after = 2;          ///< keyframes, after which a new point ...
  int least_confirmed_weight = 4;   ///< ... has this observation weight (depth counts 2)
  int probation = 3;                ///< keyframes over which points are new
  int least_weight = 3;             ///< of a point that loses an observation: else it dies
  double redundant_share = 0.9;     ///< of a keyframe's close points seen elsewhere ...
  int redundant_observers = 3;      ///< ... by this many as sharply: it is not needed
  /// Frames from a keyframe to its new points; those to its adjustment are
  /// ScheduleOptions::mapping_frames, these included.
  int points_after_frames = 1;
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, OrbSlam2MappingOptions& options);

}  // namespace aisle::slam
