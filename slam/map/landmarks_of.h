#pragma once

#include <vector>

#include "slam/map/map.h"

namespace aisle::slam {

/// The landmarks that any of the keyframes sees, by id, each once.
std::vector<LandmarkId> LandmarksOf(const Map& map, const std::vector<KeyframeId>& keyframes);

}  // namespace aisle::slam
