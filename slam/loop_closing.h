#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/optimize/adjust_map.h"
#include "slam/slam_options.h"

namespace aisle::slam {

/// Closes a loop: spreads its error over the map, joins the landmarks that both visits saw, then
/// adjusts everything. Takes the map by value and returns the next one: it can run beside readers.
Map CloseLoop(Map map, const std::vector<LoopEdge>& loops, const StereoCamera& camera,
              const SlamOptions& options);

}  // namespace aisle::slam
