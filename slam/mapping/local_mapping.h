#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/mapping/mapping_options.h"
#include "slam/optimize/adjust_map.h"
#include "slam/place/place_index.h"

namespace aisle::slam {

/// What working a keyframe in looks at besides the map. Outlives the work.
struct MappingTools {
  const Vocabulary* vocabulary = nullptr;
  const PlaceIndex& index;
  const StereoCamera& camera;
  int levels;  ///< of the pyramids
  const MappingOptions& options;
  const LoopOptions& loop;
};

/// What mapping made of a keyframe.
struct MappingResult {
  Map map;
  KeyframeId keyframe;             ///< the one worked in
  std::vector<KeyframeId> culled;  ///< keyframes that went
  WordVector words;                ///< of the keyframe; empty without a vocabulary
  /// The older place that it shows, if it does, also as the keyframes beside it see that; its own
  /// view comes last.
  std::vector<LoopEdge> loops;
  double milliseconds = 0;  ///< reported, never decided upon
};

/// Fills in the words of a keyframe and the older place that it shows, if there is a vocabulary.
void LookForLoops(const Map& map, KeyframeId newest, const MappingTools& tools,
                  MappingResult& result);

/// Works the newest keyframe into the map: drops landmarks that have not proven themselves, joins
/// those that neighbours know too, adjusts poses and points around, and drops keyframes that have
/// become redundant; then looks for an older place that it shows, if there is a vocabulary. Takes
/// the map by value and returns the next one: it can run beside readers.
MappingResult MapKeyframe(Map map, KeyframeId newest, const MappingTools& tools);

}  // namespace aisle::slam
