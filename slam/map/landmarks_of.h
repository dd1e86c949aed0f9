#pragma once

#include <vector>

#include "slam/map/map.h"

namespace aisle::slam {

/// The landmarks that any of the keyframes sees, by id, each once.
std::vector<LandmarkId> LandmarksOf(const Map& map, const std::vector<KeyframeId>& keyframes);

/// Those of the landmarks that the map has (still), in the same order.
std::vector<const Landmark*> FindAll(const Map& map, const std::vector<LandmarkId>& landmarks);

}  // namespace aisle::slam
