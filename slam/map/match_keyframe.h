#pragma once

#include <vector>

#include "slam/map/match_by_projection.h"

namespace aisle::slam {

/// Matches the landmarks of a keyframe to features of a frame by description alone. Each landmark
/// chooses the nearest feature, within `distance` bits and not above `ratio` x the second nearest;
/// a feature that several choose goes to the nearest of those. A landmark nearer still that chooses
/// another feature is no hindrance: the match need not be mutually best. By rising feature.
std::vector<Match> MatchKeyframe(const Map& map, const Keyframe& keyframe, const Frame& frame,
                                 int distance, double ratio);

}  // namespace aisle::slam
