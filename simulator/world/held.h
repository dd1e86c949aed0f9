#pragma once

#include "simulator/mesh/pose.h"

namespace aisle::sim {

/// The model with a thing fixed to one of its nodes: goods on forks, a box in the arms. `thing` is
/// in the object's frame as it lies when the nodes are at `frames`. Only vertices are added; the
/// mesh that shows them keeps its own topology and materials.
Model Carrying(const Model& model, const TriangleMesh& thing, int node, const NodeFrames& frames);

}  // namespace aisle::sim
