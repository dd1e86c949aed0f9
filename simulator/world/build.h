#pragma once

#include <cstdint>
#include <string>

#include "simulator/scene/scene.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// Lays out a scene: the building, what is stored in it, its lights, its actors and the rig's way.
/// Everything the scene leaves open (which carton where, stains, looks, the actors' timing within
/// their bounds) is decided by the seed. Throws std::runtime_error with file:line:column when a
/// model is missing or does not fit its use.
World BuildWorld(const Scene& written, const std::string& assets_dir, std::uint64_t seed);

}  // namespace aisle::sim
