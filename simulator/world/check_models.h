#pragma once

#include <string>
#include <vector>

#include "simulator/scene/scene.h"
#include "simulator/world/assets.h"

namespace aisle::sim {

/// A message for each model that the scene names and the library does not have, with the place of
/// the key that names it and the names there are. Opens no model.
std::vector<std::string> CheckModels(const Scene& scene, const AssetLibrary& assets);

}  // namespace aisle::sim
