#pragma once

#include "simulator/mesh/gltf_nodes.h"

namespace aisle::sim {

/// Adds the file's animations as clips. Each channel acts on the node its target's index names;
/// channels for nodes outside the scene, or for no node, do nothing (glTF 2.0, 3.11). Throws
/// ImportError for keys that are not rising or not finite, for two channels that move the same
/// thing, and for animated morph targets.
void AddGltfClips(const GltfDocument& document, const GltfNodes& nodes,
                  const ImportOptions& options, Model* model);

}  // namespace aisle::sim
