#pragma once

#include "simulator/world/actors.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {

/// Places the scene's pieces of the kit. Throws std::runtime_error naming file, line and column of
/// one whose model is not there.
void AddProps(const Scene& scene, std::uint64_t seed, AssetLibrary* assets, Wardrobe* wardrobe,
              WorldBuilder* builder);

}  // namespace aisle::sim
