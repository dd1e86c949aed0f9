#pragma once

#include "slam/map/map.h"

namespace aisle::slam {

/// What landmark `id` of the map `before` is in the map `now`, which has taken its place: itself,
/// or the landmark it has become one with, or the one that a keyframe added anew has brought again
/// under another id. Invalid where it is gone.
LandmarkId Successor(const Map& before, const Map& now, LandmarkId id);

/// A new keyframe for the map `before`, as it has to be told to `now`: it and what it has brought
/// stand to the keyframe it was tracked from as before, wherever that has moved.
MapEdit CarriedOver(MapEdit keyframe, const Map& before, const Map& now);

}  // namespace aisle::slam
