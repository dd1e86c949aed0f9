#pragma once

#include "simulator/scene/floor_way.h"
#include "simulator/world/actors.h"

namespace aisle::sim {

/// Whether a person brings a motion or a body of the user's own.
bool IsCaptured(const PersonSpec& person);

/// A person who moves as a BVH file has it, in one of our bodies or in the user's own with the same
/// skeleton; or a skinned model of the user's own that plays one of its animations along its route.
/// Throws std::runtime_error: a file that cannot be read, a body without such a skeleton, a clip
/// that does not exist.
Actor MakeCapturedPerson(const PersonSpec& person, AssetLibrary* assets, Wardrobe* wardrobe);

/// Where such a person goes who moves as a BVH file has it. Throws likewise.
FloorWay RecordedWay(const PersonSpec& person, AssetLibrary* assets);

/// Throws std::runtime_error where a model of the user's own cannot be read or has no such clip.
void CheckClip(const PersonSpec& person, AssetLibrary* assets);

}  // namespace aisle::sim
