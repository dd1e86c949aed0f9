#pragma once

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// A rig's route as the vehicle of a closed drive can go it: nowhere faster than that drives,
/// turns, speeds up, brakes and steers. The very same where it can do all that the rig's own limits
/// ask.
RouteSpec WithinReach(RouteSpec route, const DriveSpec& drive);

}  // namespace aisle::sim
