#pragma once

#include "simulator/mesh/gltf_document.h"

namespace aisle::sim {

/// Which of a model's nodes each node of the file became, by its index in the file: the only thing
/// by which a node is known here, for names may repeat or be missing. -1: not part of the scene.
struct GltfNodes {
  std::vector<int> of_file;
  /// Nodes of the scene in the order they were added; their indices in the file.
  std::vector<std::size_t> in_order;
};

/// Translation, rotation (of unit length) and scale as a node states them; unset where it does not.
struct GltfPose {
  std::optional<Eigen::Vector3f> translation;
  std::optional<Eigen::Quaternionf> rotation;
  std::optional<Eigen::Vector3f> scale;
};
GltfPose StatedPose(const GltfValue& node);

/// Adds the nodes of the file's scene below model node 0, parents before children. Without a scene
/// all nodes that have no parent are its roots. Throws ImportError unless the nodes form trees (a
/// child that does not exist, two parents, a cycle, a tree more than 500 deep; glTF 2.0, 3.5.2).
GltfNodes AddGltfNodes(const GltfDocument& document, Model* model);

}  // namespace aisle::sim
