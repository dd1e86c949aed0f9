#pragma once

#include "simulator/mesh/gltf_document.h"

namespace aisle::sim {

/// What the file holds and is not read, each a phrase with its count, in a fixed order: cameras,
/// lights, points and lines, shapes to morph into, vertex colours, textures of other uses or
/// formats, transparency, extensions.
std::vector<std::string> LeftOutOfGltf(const GltfDocument& document);

}  // namespace aisle::sim
