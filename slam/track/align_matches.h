#pragma once

#include <vector>

#include "slam/map/match_by_projection.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// What the frame measures of the landmarks that its features have been matched to, one for each
/// match. Where a keyframe has seen a landmark about as large as the frame does from `T_rig_world`,
/// its patch there is found again in the frame to a fraction of a pixel: the oldest such
/// keyframe's, so that errors do not add up. Elsewhere, and where the frame keeps no patches, what
/// the feature itself measures.
std::vector<Measurement> AlignMatches(const PlainContext& context,
                                      const Eigen::Isometry3d& T_rig_world,
                                      const std::vector<Match>& matches);

}  // namespace aisle::slam
