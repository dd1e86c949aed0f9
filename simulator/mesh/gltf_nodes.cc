#include "simulator/mesh/gltf_nodes.h"

#include <assimp/types.h>

#include "simulator/mesh/pose.h"

namespace aisle::sim {
namespace {

constexpr int kDeepest = 500;
constexpr float kUnit = 1e-4f;  ///< that a unit quaternion's length may be off by

/// Parent of every node, -1 for roots.
std::vector<int> ParentsOf(const std::vector<GltfValue>& nodes) {
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const GltfValue& child : nodes[i].Items("children")) {
      int& parent = parents[child.IndexBelow(nodes.size(), "node")];
      if (parent >= 0) {
        child.Fail(
            fmt::format("node {} is a child of node {} and of node {}; the nodes of a model "
                        "must form a tree",
                        child.Whole(), parent, i));
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

void CheckTree(const std::vector<GltfValue>& nodes, const std::vector<int>& parents) {
  for (std::size_t i = 0; i < parents.size(); ++i) {
    int above = 0;
    for (int node = parents[i]; node >= 0; node = parents[static_cast<std::size_t>(node)]) {
      if (node == static_cast<int>(i)) {
        nodes[i].Fail("it hangs below itself; the nodes of a model must form a tree");
      }
      if (++above > kDeepest) {
        nodes[i].Fail(fmt::format("more than {} nodes hang one below another", kDeepest));
      }
    }
  }
}

std::vector<std::size_t> RootsOf(const GltfDocument& document, const std::vector<int>& parents) {
  const GltfValue root = document.root();
  const std::size_t scenes = root.Count("scenes");
  const std::size_t shown = root.IndexBelow("scene", scenes, "scene").value_or(0);
  std::vector<std::size_t> roots;
  if (scenes == 0) {
    for (std::size_t i = 0; i < parents.size(); ++i) {
      if (parents[i] < 0) roots.push_back(i);
    }
    return roots;
  }
  for (const GltfValue& node : root.Item("scenes", shown).Items("nodes")) {
    const std::size_t index = node.IndexBelow(parents.size(), "node");
    if (parents[index] >= 0) node.Fail(fmt::format("node {} is not a root", index));
    if (std::ranges::find(roots, index) != roots.end()) {
      node.Fail(fmt::format("node {} is named twice", index));
    }
    roots.push_back(index);
  }
  return roots;
}

NodePose PoseFromMatrix(const aiMatrix4x4& matrix) {
  aiVector3D scale, position;
  aiQuaternion rotation;
  matrix.Decompose(scale, rotation, position);
  return {{position.x, position.y, position.z},
          Eigen::Quaternionf(rotation.w, rotation.x, rotation.y, rotation.z).normalized(),
          {scale.x, scale.y, scale.z}};
}

/// Translation, rotation and scale of a node that is written as a matrix (by columns).
NodePose DecomposedPose(const GltfValue& node) {
  const std::vector<float> m = node.Numbers("matrix", 16);
  const NodePose pose = PoseFromMatrix({m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13],  //
                                        m[2], m[6], m[10], m[14], m[3], m[7], m[11], m[15]});
  if (!IsComposedOf(Eigen::Map<const Eigen::Matrix4f>(m.data()), pose)) {
    node.Get("matrix").Fail(
        "its matrix is not made of translation, rotation and scale, as a node's must be (glTF 2.0, "
        "3.5.3); apply shear before the export");
  }
  return pose;
}

NodePose RestOf(const GltfValue& node) {
  if (node.Has("matrix")) return DecomposedPose(node);
  const GltfPose stated = StatedPose(node);
  NodePose pose;
  if (stated.translation) pose.translation = *stated.translation;
  if (stated.rotation) pose.rotation = *stated.rotation;
  if (stated.scale) pose.scale = *stated.scale;
  if (pose.scale.minCoeff() <= 0) {  // a matrix would not say which axis is mirrored
    pose.rotation.normalize();
    return pose;
  }
  // By way of the matrix, as for nodes that are written as one: the same bits for both.
  aiMatrix4x4 translation, scale;
  aiMatrix4x4::Translation({pose.translation.x(), pose.translation.y(), pose.translation.z()},
                           translation);
  aiMatrix4x4::Scaling({pose.scale.x(), pose.scale.y(), pose.scale.z()}, scale);
  const aiQuaternion rotation(pose.rotation.w(), pose.rotation.x(), pose.rotation.y(),
                              pose.rotation.z());
  return PoseFromMatrix(translation * aiMatrix4x4(rotation.GetMatrix()) * scale);
}

}  // namespace

GltfPose StatedPose(const GltfValue& node) {
  const std::vector<float> t = node.Numbers("translation", 3), r = node.Numbers("rotation", 4),
                           s = node.Numbers("scale", 3);
  GltfPose pose;
  if (!t.empty()) pose.translation.emplace(t[0], t[1], t[2]);
  if (!r.empty()) {
    pose.rotation.emplace(r[3], r[0], r[1], r[2]);
    const float norm = pose.rotation->norm();
    if (!(norm > 0)) node.Get("rotation").Fail("it must be a unit quaternion");
    if (std::abs(norm - 1) > kUnit) pose.rotation->normalize();
  }
  if (!s.empty()) pose.scale.emplace(s[0], s[1], s[2]);
  return pose;
}

GltfNodes AddGltfNodes(const GltfDocument& document, Model* model) {
  const std::vector<GltfValue> nodes = document.root().Items("nodes");
  if (nodes.size() > kMostModelNodes)
    throw ImportError(fmt::format("it has over {} nodes", kMostModelNodes));
  const std::vector<int> parents = ParentsOf(nodes);
  CheckTree(nodes, parents);
  GltfNodes known{std::vector<int>(nodes.size(), -1), {}};
  std::vector<std::size_t> open = RootsOf(document, parents);
  std::ranges::reverse(open);
  while (!open.empty()) {
    const std::size_t index = open.back();
    open.pop_back();
    const int parent =
        parents[index] < 0 ? 0 : known.of_file[static_cast<std::size_t>(parents[index])];
    known.of_file[index] = static_cast<int>(model->nodes.size());
    known.in_order.push_back(index);
    model->nodes.push_back({nodes[index].Text("name", ""), parent, RestOf(nodes[index])});
    const std::vector<GltfValue> children = nodes[index].Items("children");
    for (std::size_t i = children.size(); i-- > 0;) open.push_back(children[i].Whole());
  }
  return known;
}

}  // namespace aisle::sim
