#pragma once

#include "simulator/scene/bag_poses.h"
#include "simulator/scene/issues.h"
#include "simulator/scene/scene.h"

namespace aisle::sim {

/// Reads what the scene's rig takes from files of the user: its calibration, which decides the
/// camera, and its trajectory, out of a bag by `bags`. Each name is meant from the folder of the
/// file that gives it, and they are added to `scene->files`. Mistakes go to `issues`.
void ReadRigFiles(Scene* scene, const BagPoseReader& bags, Issues* issues);

}  // namespace aisle::sim
