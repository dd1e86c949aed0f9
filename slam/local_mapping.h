#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/slam_options.h"

namespace aisle::slam {

/// What mapping made of a keyframe.
struct MappingResult {
  Map map;
  BundleSummary adjustment;
  double milliseconds = 0;  ///< reported, never decided upon
};

/// Works the newest keyframe into the map: drops landmarks that have not proven themselves, joins
/// those that neighbours know too, adjusts poses and points around, and drops keyframes that have
/// become redundant. Takes the map by value and returns the next one: it can run beside readers.
MappingResult MapKeyframe(Map map, KeyframeId newest, const StereoCamera& camera,
                          const MappingOptions& options);

}  // namespace aisle::slam
