#pragma once

#include "slam/common/option_fields.h"
#include "slam/mapping/mapping_policy.h"

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

/// New landmarks go that are hardly found again, or that nobody has confirmed in time.
MapEdit OrbSlam2CullLandmarks(const Map& map, KeyframeId newest,
                              const OrbSlam2MappingOptions& options);

/// Keyframes around `newest` go whose close points others see as well.
MapEdit OrbSlam2CullKeyframes(const Map& map, KeyframeId newest, const StereoCamera& camera,
                              const OrbSlam2MappingOptions& options);

/// Those of `landmarks` go that have too few observations left.
MapEdit OrbSlam2DropUnsupported(const Map& map, const std::vector<LandmarkId>& landmarks,
                                const OrbSlam2MappingOptions& options);

/// Places a point by the two rays if their angle is wider than that between the two cameras, else
/// by the disparity of the view that has it better; nothing where neither is.
PlacePoint OrbSlam2Place(double least_ray_sine);

/// The neighbours to exchange points with, and theirs.
std::vector<KeyframeId> OrbSlam2FuseNeighbours(const Map& map, KeyframeId id,
                                               const FuseOptions& fuse,
                                               const OrbSlam2MappingOptions& options);

/// How ORB-SLAM2 works a keyframe in, in three steps: landmarks go and come; they are exchanged
/// with neighbours; everything around is adjusted and keyframes go. Where other keyframes wait when
/// a step begins, only the best neighbour helps to place landmarks, nothing is exchanged, nothing
/// is adjusted and no keyframe goes. An adjustment under way is given up after its first pass once
/// a keyframe is wanted.
MappingPolicy OrbSlam2Mapping(const OrbSlam2MappingOptions& options, int mapping_frames);

}  // namespace aisle::slam
