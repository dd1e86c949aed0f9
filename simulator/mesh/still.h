#pragma once

#include "simulator/mesh/model.h"

namespace aisle::sim {

/// The model as it stands at rest: no clips, no skeleton, every node in its place. A node's name is
/// its whole path, "hall/racks/rack_03"; which triangles a node shows stays known. Nothing shines.
/// What animations and lamps there were is added to what was left out.
Model StillOf(Model model);

/// The node that each triangle follows: of its first corner's heaviest joint.
std::vector<int> NodesOfTriangles(const Model& model);

}  // namespace aisle::sim
