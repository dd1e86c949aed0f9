#pragma once

#include <filesystem>
#include <string>

namespace aisle::sim {

/// What is wrong with the node hierarchy of a .gltf or .glb file, or empty: a child that does not
/// exist, two parents, a cycle, a tree more than 500 deep. Looked at before assimp sees the file,
/// which follows a cycle until its stack ends (glTF 2.0, 3.5.2: nodes form disjoint strict trees).
/// A file whose JSON cannot be read gives no complaint here: assimp has its own.
std::string GltfNodeError(const std::filesystem::path& file);

}  // namespace aisle::sim
