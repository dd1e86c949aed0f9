#pragma once

#include <vector>

#include "slam/map/match_by_projection.h"

namespace aisle::slam {

/// Matches the landmarks of a keyframe to features of a frame by description alone: mutual best,
/// within `distance` bits, and below `ratio` x the second best. By rising feature.
std::vector<Match> MatchKeyframe(const Map& map, const Keyframe& keyframe, const Frame& frame,
                                 int distance, double ratio);

}  // namespace aisle::slam
