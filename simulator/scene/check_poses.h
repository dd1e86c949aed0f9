#pragma once

#include <string>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// What is wrong with how a recorded rig stands for most of the scene's time, or an empty string: a
/// vehicle that leans by more than 65 degrees, or a camera on or below the floor. Beneath a
/// recorded camera that is the vehicle on which the scene mounts it, so that who wants a camera
/// that looks down, or hangs upside down, writes that; level and ahead where nothing is written.
/// The sentence names what usually is behind it.
std::string PosesError(const Scene& scene);

}  // namespace aisle::sim
