#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

namespace aisle::sim {

/// What assimp read of a file and a model does not take, each a phrase with its count.
std::vector<std::string> LeftOutOf(const aiScene& scene);

}  // namespace aisle::sim
