#include "simulator/world/held.h"

namespace aisle::sim {

Model Carrying(const Model& model, const TriangleMesh& thing, int node, const NodeFrames& frames) {
  Model loaded = model;
  const auto joint = static_cast<std::uint16_t>(loaded.joints.size());
  loaded.joints.push_back({node, frames[static_cast<std::size_t>(node)].inverse()});
  loaded.bind_positions.insert(loaded.bind_positions.end(), thing.positions.begin(),
                               thing.positions.end());
  loaded.bind_normals.insert(loaded.bind_normals.end(), thing.normals.begin(), thing.normals.end());
  loaded.weights.insert(loaded.weights.end(), thing.positions.size(),
                        VertexWeights{{joint, 0, 0, 0}, {1, 0, 0, 0}});
  return loaded;
}

}  // namespace aisle::sim
