#pragma once

#include "slam/track/local_map.h"
#include "slam/track/orbslam2_options.h"

namespace aisle::slam {

/// The surroundings of a frame that sees `landmarks`, as ORB-SLAM2 gathers them: every keyframe
/// that sees any of them, oldest first; while they are fewer than `local_keyframes`, each brings
/// the first of its best neighbours that is not there yet, a child and its parent. The first parent
/// that is new ends the growth, as published. Landmarks by keyframe, then by feature.
LocalMap OrbSlam2LocalMap(const Map& map, const std::vector<LandmarkId>& landmarks,
                          const OrbSlam2Options& options);

}  // namespace aisle::slam
