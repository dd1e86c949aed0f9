#pragma once

#include <Eigen/Core>

#include "slam/map/map.h"

namespace aisle::slam {

/// Recomputes what a landmark's observations imply: descriptor, normal, reference distance.
void RefreshView(const Map& map, Landmark& landmark);

/// The pyramid level at which a landmark should be found from `distance_m` away: what is seen
/// nearer is seen larger, at a higher level. Within [0, levels).
int PredictLevel(const Landmark& landmark, double distance_m, double scale, int levels);

/// Whether a landmark can be expected to be recognised from `centre` (world): seen from within 60
/// degrees of where it has been seen, and from a distance at which some level fits.
bool CanBeSeenFrom(const Landmark& landmark, const Eigen::Vector3d& centre, double scale,
                   int levels);

}  // namespace aisle::slam
