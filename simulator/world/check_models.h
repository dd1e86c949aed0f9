#pragma once

#include <string>
#include <vector>

#include "simulator/scene/scene.h"
#include "simulator/world/assets.h"

namespace aisle::sim {

/// A message for each model that the scene or a hall that a seed may deal names and the library
/// does not have, for what is asked of one that it cannot do by the library's manifest (a clip, a
/// load, a lift, a fork that takes), and where there are more movers than a world holds: each with
/// the place of the key. Opens no model.
std::vector<std::string> CheckModels(const Scene& scene, const AssetLibrary& assets);

}  // namespace aisle::sim
