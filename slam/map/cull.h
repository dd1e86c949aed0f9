#pragma once

#include <set>

#include "slam/common/option_fields.h"
#include "slam/map/map.h"

namespace aisle::slam {

struct CullOptions {
  double least_found_ratio = 0.25;  ///< of the frames that should have seen a landmark
  int probation_keyframes = 2;      ///< after this many more keyframes a landmark must be confirmed
  int least_weight = 3;             ///< observation weight (depth counts 2) of a confirmed one
  double redundant_share = 0.9;     ///< of a keyframe's landmarks seen elsewhere: it is not needed
  int redundant_observers = 3;      ///< "seen elsewhere" is in this many keyframes as sharply
  int recent_keyframes = 2;         ///< the newest keyframes are never culled
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, CullOptions& options);

/// Whether at least `observers` other keyframes, those `going` left out, see the landmark at the
/// scale of its observation `own` or a finer one.
bool SeenElsewhere(const Map& map, const Landmark& landmark, const Observation& own,
                   const std::set<KeyframeId>& going, int observers);

/// Removes landmarks that are hardly found again or that no second keyframe has confirmed.
MapEdit CullLandmarks(const Map& map, KeyframeId newest, const CullOptions& options);

/// Removes keyframes near `newest` that show nothing the others do not.
MapEdit CullKeyframes(const Map& map, KeyframeId newest, const CullOptions& options);

}  // namespace aisle::slam
