#pragma once

#include <vector>

#include "slam/map/match_by_projection.h"
#include "slam/optimize/refine_pose.h"

namespace aisle::slam {

/// What a pose is found from: the landmarks of the matches, where the map has them, and where the
/// features of the frame show them.
std::vector<PointObservation> ObservationsOf(const Map& map, const Frame& frame,
                                             const std::vector<Match>& matches);

/// The same, seen where `measurements` has it of each match.
std::vector<PointObservation> ObservationsOf(const Map& map,
                                             const std::vector<Measurement>& measurements,
                                             const std::vector<Match>& matches);

}  // namespace aisle::slam
