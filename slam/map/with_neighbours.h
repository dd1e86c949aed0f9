#pragma once

#include <set>

#include "slam/map/map.h"

namespace aisle::slam {

/// Keyframes and their neighbours: who shares kLeastCovisible landmarks or more with one of them.
std::set<KeyframeId> WithNeighbours(const Map& map, const std::set<KeyframeId>& keyframes);

}  // namespace aisle::slam
