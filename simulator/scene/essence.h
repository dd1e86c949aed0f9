#pragma once

#include <filesystem>
#include <string>

#include "simulator/scene/bag_poses.h"

namespace aisle::sim {

/// What a scene's pixels and truth are decided by, as text in a form of its own: the file laid over
/// those it extends and the hall it takes (each of them, where halls vary), keys in order, without
/// comments, without `about` and the name of the extended file, and without `people`, `vehicles`
/// and `crowd` where they are not to be seen; then what the files hold that it names: of its rig,
/// of motions, and of meshes, which are one file each (OpenUserModel). Scenes of equal essence give
/// equal frames for the same twin, seed and assets. Throws SceneError where the file cannot be read
/// as YAML; other mistakes are not looked for. `bags` as LoadScene has it.
std::string EssenceOf(const std::filesystem::path& file, bool with_actors,
                      const BagPoseReader& bags = {});

}  // namespace aisle::sim
