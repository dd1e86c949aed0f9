#include "simulator/mesh/pose.h"

#include <algorithm>
#include <cmath>

namespace aisle::sim {
namespace {

Eigen::Vector3f Mix(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float share) {
  return a + share * (b - a);
}

Eigen::Quaternionf Mix(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float share) {
  return a.slerp(share, b);
}

/// Value of a key list at a time; `otherwise` when it has no keys.
template <class Value>
Value KeyedValue(const std::vector<std::pair<float, Value>>& keys, float time,
                 const Value& otherwise) {
  if (keys.empty()) return otherwise;
  const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](float t, const auto& key) { return t < key.first; });
  if (after == keys.begin()) return keys.front().second;
  if (after == keys.end()) return keys.back().second;
  const auto before = std::prev(after);
  return Mix(before->second, after->second,
             (time - before->first) / (after->first - before->first));
}

NodePose Mix(const NodePose& a, const NodePose& b, float share) {
  return {Mix(a.translation, b.translation, share), Mix(a.rotation, b.rotation, share),
          Mix(a.scale, b.scale, share)};
}

std::vector<NodePose> RestPose(const Model& model) {
  std::vector<NodePose> locals;
  locals.reserve(model.nodes.size());
  for (const ModelNode& node : model.nodes) locals.push_back(node.rest);
  return locals;
}

std::vector<NodePose> PoseOf(const Model& model, const PoseLayer& layer) {
  std::vector<NodePose> locals = RestPose(model);
  if (layer.clip < 0) return locals;
  const Clip& clip = model.clips[static_cast<std::size_t>(layer.clip)];
  const double turns = clip.duration_s > 0 ? layer.time_s / clip.duration_s : 0;
  const float time = static_cast<float>((turns - std::floor(turns)) * clip.duration_s);
  for (const ClipChannel& channel : clip.channels) {
    NodePose& local = locals[static_cast<std::size_t>(channel.node)];
    local.translation = KeyedValue(channel.translations, time, local.translation);
    local.rotation = KeyedValue(channel.rotations, time, local.rotation);
    local.scale = KeyedValue(channel.scales, time, local.scale);
  }
  return locals;
}

/// Whether each node is `top` or hangs below it.
std::vector<bool> Below(const Model& model, int top) {
  std::vector<bool> below(model.nodes.size(), false);
  for (std::size_t i = 0; i < below.size(); ++i) {
    const int parent = model.nodes[i].parent;
    below[i] =
        static_cast<int>(i) == top || (parent >= 0 && below[static_cast<std::size_t>(parent)]);
  }
  return below;
}

Eigen::Affine3f Matrix(const NodePose& pose) {
  Eigen::Affine3f matrix = Eigen::Affine3f::Identity();
  matrix.linear() = pose.rotation.toRotationMatrix() * pose.scale.asDiagonal();
  matrix.translation() = pose.translation;
  return matrix;
}

/// The weighted matrix of one vertex.
Eigen::Affine3f VertexMatrix(const VertexWeights& vertex,
                             std::span<const Eigen::Affine3f> joint_matrices) {
  if (vertex.weights[1] == 0) return joint_matrices[vertex.joints[0]];
  Eigen::Affine3f sum;
  sum.matrix() = vertex.weights[0] * joint_matrices[vertex.joints[0]].matrix();
  for (std::size_t k = 1; k < 4 && vertex.weights[k] > 0; ++k) {
    sum.matrix() += vertex.weights[k] * joint_matrices[vertex.joints[k]].matrix();
  }
  return sum;
}

}  // namespace

std::vector<NodePose> BlendLayers(const Model& model, std::span<const PoseLayer> layers) {
  std::vector<NodePose> locals = RestPose(model);
  float total = 0;
  for (const PoseLayer& layer : layers) {  // whole-body layers, by weight
    if (layer.below_node >= 0 || layer.weight <= 0) continue;
    const std::vector<NodePose> pose = PoseOf(model, layer);
    total += layer.weight;
    const float share = layer.weight / total;
    for (std::size_t i = 0; i < locals.size(); ++i) locals[i] = Mix(locals[i], pose[i], share);
  }
  for (const PoseLayer& layer : layers) {  // part-body layers, over them
    if (layer.below_node < 0 || layer.weight <= 0) continue;
    const std::vector<NodePose> pose = PoseOf(model, layer);
    const std::vector<bool> below = Below(model, layer.below_node);
    for (std::size_t i = 0; i < locals.size(); ++i) {
      if (below[i]) locals[i] = Mix(locals[i], pose[i], std::min(layer.weight, 1.0f));
    }
  }
  return locals;
}

NodeFrames FramesOf(const Model& model, std::span<const NodePose> locals,
                    std::span<const NodeMove> moves) {
  NodeFrames frames(model.nodes.size());
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = Matrix(locals[i]);
  for (const NodeMove& move : moves) {
    Eigen::Affine3f& frame = frames[static_cast<std::size_t>(move.node)];
    frame = frame * move.in_node;
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const int parent = model.nodes[i].parent;
    if (parent >= 0) frames[i] = frames[static_cast<std::size_t>(parent)] * frames[i];
  }
  return frames;
}

NodeFrames PoseNodes(const Model& model, std::span<const PoseLayer> layers,
                     std::span<const NodeMove> moves) {
  return FramesOf(model, BlendLayers(model, layers), moves);
}

std::vector<Eigen::Affine3f> JointMatrices(const Model& model, const NodeFrames& frames) {
  std::vector<Eigen::Affine3f> matrices;
  matrices.reserve(model.joints.size());
  for (const ModelJoint& joint : model.joints) {
    matrices.push_back(frames[static_cast<std::size_t>(joint.node)] * joint.bind_to_node);
  }
  return matrices;
}

void SkinVertices(const Model& model, std::span<const Eigen::Affine3f> joint_matrices,
                  std::vector<Eigen::Vector3f>* positions, std::vector<Eigen::Vector3f>* normals) {
  const std::size_t count = model.bind_positions.size();
  positions->resize(count);
  normals->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Affine3f matrix = VertexMatrix(model.weights[i], joint_matrices);
    (*positions)[i] = matrix * model.bind_positions[i];
    (*normals)[i] = (matrix.linear() * model.bind_normals[i]).normalized();
  }
}

void BlendVertices(const Model& model, std::span<const Eigen::Affine3f> joint_matrices,
                   std::vector<Eigen::Vector3f>* positions) {
  const std::size_t count = model.bind_positions.size();
  positions->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Affine3f matrix = VertexMatrix(model.weights[i], joint_matrices);
    (*positions)[i] = matrix * model.bind_positions[i];
  }
}

}  // namespace aisle::sim
