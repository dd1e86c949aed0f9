#pragma once

#include <vector>

#include "slam/map/match_by_projection.h"
#include "slam/optimize/refine_pose.h"
#include "slam/track/track_options.h"
#include "slam/track/tracking_context.h"

namespace aisle::slam {

// Somebody close hides another part of the world from each camera: what should be seen of the map
// and is not found in the left image is looked for in the right one. Observations, and what a pose
// from them has as inliers, are those of the left camera's matches, then those of the right one's.

using PlainContext = TrackingContext<TrackOptions>;

/// The same context for the left camera alone. Chance makes more of the right one's matches, which
/// no disparity contradicts, and they are less exact: it is asked where the left one does not
/// convince and something else tells where the rig must be.
PlainContext LeftAlone(const PlainContext& context);

/// Matches to the right camera's features those landmarks of `expected` that are not among
/// `matches`, the left one's. None where it is not asked.
std::vector<Match> MatchRight(const PlainContext& context, const std::vector<Expected>& expected,
                              const std::vector<Match>& matches, const MatchOptions& options);

/// What the matches of both cameras tell of the pose; the left ones as `measurements` has them.
std::vector<PointObservation> ObservationsOfBoth(const PlainContext& context,
                                                 const std::vector<Measurement>& measurements,
                                                 const std::vector<Match>& matches,
                                                 const std::vector<Match>& right_matches);

/// The same as the left camera's features themselves measure.
std::vector<PointObservation> ObservationsOfBoth(const PlainContext& context,
                                                 const std::vector<Match>& matches,
                                                 const std::vector<Match>& right_matches);

/// The landmarks of the matches that a pose from those observations keeps.
std::vector<LandmarkId> InliersOfBoth(const std::vector<Match>& matches,
                                      const std::vector<Match>& right_matches,
                                      const RefinedPose& pose);

}  // namespace aisle::slam
