#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// Where a scene's rig is: the left camera of the pair that is shown, T_world_rig, as its route or
/// its recorded trajectory has it. Pure.
std::function<Eigen::Isometry3d(std::int64_t stamp_ns)> RigPathOf(const Scene& scene);

/// Where whoever keeps clear of the rig finds it on the floor: its vehicle's origin and heading, or
/// below a recorded camera, the way that looks. Position and heading alone on a recorded way. Pure.
std::function<RouteState(double time_s)> RigFloorOf(const Scene& scene);

}  // namespace aisle::sim
