#pragma once

#include <string>
#include <vector>

#include "simulator/scene/floor_way.h"
#include "simulator/scene/scene.h"
#include "simulator/world/assets.h"

namespace aisle::sim {

/// Where those people of a scene go who move as a BVH file has them; reads that file and lays it on
/// the model that the scene names (another of the same height goes as far). Throws
/// std::runtime_error with the place of the key where that cannot be done.
FloorWays RecordedWays(const Scene& scene, AssetLibrary* assets);

/// What is wrong with the people of a good scene who bring a motion or a body of the user's own: a
/// file that cannot be read, a clip that it lacks, a motion that leads through something or
/// somebody. Each with the place of the key. Opens their models, and none where there are none.
std::vector<std::string> CheckCaptured(const Scene& scene, AssetLibrary* assets);

}  // namespace aisle::sim
