#pragma once

#include "simulator/world/actors.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {

/// The building that the scene's hall names as a mesh of the user's own: an instance for each node
/// that shows something, labelled by its name (simulator/world/labels.h). A shell around the rig's
/// first place faces it (simulator/world/shell.h). Throws
/// std::runtime_error when it has more of them than can be told apart.
void AddOwnHall(const Scene& scene, AssetLibrary* assets, Wardrobe* wardrobe,
                WorldBuilder* builder);

}  // namespace aisle::sim
