#pragma once

#include <functional>
#include <vector>

#include "slam/mapping/local_mapping.h"

namespace aisle::slam {

/// A part of the work on a keyframe whose result the tracker sees by itself.
struct MappingStep {
  using Work = std::function<MappingResult(Map map, KeyframeId newest, const MappingTools& tools)>;
  int frames = 1;  ///< until its result is seen
  Work work;
  Work hurried;            ///< what is done instead where other keyframes wait
  int hurried_frames = 1;  ///< until the result of that is seen
  Work given_up;           ///< what is left of it once another keyframe is wanted; null: goes on
};

/// How a keyframe is worked in: at least one step.
using MappingPolicy = std::vector<MappingStep>;

/// Ours: all in one step, see MapKeyframe.
MappingPolicy PlainMapping(int mapping_frames);

}  // namespace aisle::slam
