#include "simulator/mesh/still.h"

#include "simulator/mesh/left_out.h"

namespace aisle::sim {
namespace {

/// Paths without the turn and unit above the file's own nodes.
std::vector<ModelNode> NamedByPath(const std::vector<ModelNode>& nodes) {
  std::vector<ModelNode> named;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int parent = nodes[i].parent;
    const std::string above = parent < 0 ? "" : named[static_cast<std::size_t>(parent)].name;
    named.push_back(
        {above.empty() ? nodes[i].name : above + "/" + nodes[i].name, i == 0 ? -1 : 0, {}});
  }
  return named;
}

/// Returns how many shone.
std::size_t PutOut(std::vector<Material>* materials) {
  std::size_t shone = 0;
  for (Material& material : *materials) {
    shone += material.emission > 0 ? 1 : 0;
    material.emission = 0;
  }
  return shone;
}

}  // namespace

Model StillOf(Model model) {
  LeftOut out;
  out.Add(model.clips.size(), "animation");
  out.Add(PutOut(&model.materials), "material's emission (lamps are a scene's `lights`)",
          "materials' emission (lamps are a scene's `lights`)");
  for (ModelSurfaces& band : model.colour) PutOut(&band.materials);
  for (std::string& phrase : out.Take()) model.left_out.push_back(std::move(phrase));
  model.clips.clear();
  model.nodes = NamedByPath(model.nodes);
  for (ModelJoint& joint : model.joints) joint.bind_to_node.setIdentity();
  for (VertexWeights& follows : model.weights) {
    follows = {{follows.joints[0], 0, 0, 0}, {1, 0, 0, 0}};
  }
  model.bind_positions = model.mesh.positions;
  model.bind_normals = model.mesh.normals;
  return model;
}

std::vector<int> NodesOfTriangles(const Model& model) {
  std::vector<int> nodes;
  nodes.reserve(model.mesh.triangles.size());
  for (const auto& corners : model.mesh.triangles) {
    nodes.push_back(model.joints[model.weights[corners[0]].joints[0]].node);
  }
  return nodes;
}

}  // namespace aisle::sim
