#pragma once

#include "simulator/mesh/gltf_nodes.h"

namespace aisle::sim {

/// Adds the triangles of every mesh that a node of the scene shows, in the order of the nodes.
/// Points and lines are left out. A skin's joints are named by index; without inverse bind matrices
/// they are identities, and the node that shows a skinned mesh moves nothing (glTF 2.0, 3.7.3). A
/// part that its nodes mirror has its triangles turned over, so that they stay counter-clockwise
/// from outside. Primitives without a material have the one after the file's last. Throws
/// ImportError; also for morph targets with a weight, which would be a wrong shape.
void AddGltfMeshes(const GltfDocument& document, const GltfNodes& nodes,
                   const ImportOptions& options, Model* model);

}  // namespace aisle::sim
