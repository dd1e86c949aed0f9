#pragma once

#include <set>

#include "slam/map/map.h"
#include "slam/map/map_options.h"

namespace aisle::slam {

/// Whether at least `observers` other keyframes, those `going` left out, see the landmark at the
/// scale of its observation `own` or a finer one.
bool SeenElsewhere(const Map& map, const Landmark& landmark, const Observation& own,
                   const std::set<KeyframeId>& going, int observers);

/// Removes landmarks that are hardly found again or that no second keyframe has confirmed.
MapEdit CullLandmarks(const Map& map, KeyframeId newest, const CullOptions& options);

/// Removes keyframes near `newest` that show nothing the others do not.
MapEdit CullKeyframes(const Map& map, KeyframeId newest, const CullOptions& options);

}  // namespace aisle::slam
