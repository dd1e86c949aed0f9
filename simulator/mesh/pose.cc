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

/// Sum of four values with their shares.
Eigen::Vector3f Sum(const std::array<const Eigen::Vector3f*, 4>& values,
                    const std::array<float, 4>& shares) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += shares[i] * *values[i];
  return sum;
}

Eigen::Quaternionf Sum(const std::array<const Eigen::Quaternionf*, 4>& values,
                       const std::array<float, 4>& shares) {
  Eigen::Vector4f sum = Eigen::Vector4f::Zero();
  for (std::size_t i = 0; i < 4; ++i) sum += shares[i] * values[i]->coeffs();
  return Eigen::Quaternionf(sum).normalized();
}

/// Between keys `after - 1` and `after` by glTF 2.0, appendix C.5: `t` in [0, 1].
template <class Value>
Value OnSpline(const KeyCurve<Value>& curve, std::size_t after, float t) {
  const std::size_t before = after - 1;
  const float seconds = curve.keys[after].first - curve.keys[before].first;
  const float t2 = t * t, t3 = t2 * t;
  return Sum(
      {&curve.keys[before].second, &curve.slopes[before][1], &curve.keys[after].second,
       &curve.slopes[after][0]},
      {2 * t3 - 3 * t2 + 1, seconds * (t3 - 2 * t2 + t), 3 * t2 - 2 * t3, seconds * (t3 - t2)});
}

/// Value of a curve at a time; `otherwise` when it has no keys.
template <class Value>
Value ValueAt(const KeyCurve<Value>& curve, float time, const Value& otherwise) {
  const auto& keys = curve.keys;
  if (keys.empty()) return otherwise;
  const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](float t, const auto& key) { return t < key.first; });
  if (after == keys.begin()) return keys.front().second;
  if (after == keys.end()) return keys.back().second;
  const auto before = std::prev(after);
  if (curve.interpolation == Interpolation::kStep) return before->second;
  const float share = (time - before->first) / (after->first - before->first);
  if (curve.interpolation == Interpolation::kCubic) {
    return OnSpline(curve, static_cast<std::size_t>(after - keys.begin()), share);
  }
  return Mix(before->second, after->second, share);
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
    local.translation = ValueAt(channel.translations, time, local.translation);
    local.rotation = ValueAt(channel.rotations, time, local.rotation);
    local.scale = ValueAt(channel.scales, time, local.scale);
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

/// Whether a matrix scales one axis more than another: then normals do not turn as edges do.
bool Stretches(const Eigen::Affine3f& matrix) {
  constexpr float kUneven = 1e-4f;  // of the squared scale; rounding stays far below
  const Eigen::Matrix3f gram = matrix.linear().transpose() * matrix.linear();
  const float even = gram.trace() / 3;
  return (gram - even * Eigen::Matrix3f::Identity()).cwiseAbs().maxCoeff() > kUneven * even;
}

bool FollowsStretching(const VertexWeights& vertex,
                       std::span<const Eigen::Affine3f> joint_matrices) {
  for (std::size_t k = 0; k < 4 && vertex.weights[k] > 0; ++k) {
    if (Stretches(joint_matrices[vertex.joints[k]])) return true;
  }
  return false;
}

/// By the inverse transpose, written with cofactors so that a flattened body has normals too.
Eigen::Vector3f StretchedNormal(const Eigen::Matrix3f& matrix, const Eigen::Vector3f& normal) {
  Eigen::Matrix3f cofactors;
  cofactors << matrix.col(1).cross(matrix.col(2)), matrix.col(2).cross(matrix.col(0)),
      matrix.col(0).cross(matrix.col(1));
  const float side = matrix.determinant() < 0 ? -1.0f : 1.0f;
  return (side * cofactors * normal).normalized();
}

}  // namespace

bool IsComposedOf(const Eigen::Matrix4f& matrix, const NodePose& pose) {
  constexpr float kShear = 1e-3f;
  Eigen::Matrix4f again = Eigen::Matrix4f::Identity();
  again.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix() * pose.scale.asDiagonal();
  again.topRightCorner<3, 1>() = pose.translation;
  const float largest = matrix.topLeftCorner<3, 3>().cwiseAbs().maxCoeff();
  return (matrix - again).cwiseAbs().maxCoeff() <= kShear * largest;
}

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
  const bool any_stretches = std::ranges::any_of(joint_matrices, Stretches);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Affine3f matrix = VertexMatrix(model.weights[i], joint_matrices);
    const bool stretched = any_stretches && FollowsStretching(model.weights[i], joint_matrices);
    (*positions)[i] = matrix * model.bind_positions[i];
    (*normals)[i] = stretched ? StretchedNormal(matrix.linear(), model.bind_normals[i])
                              : (matrix.linear() * model.bind_normals[i]).normalized();
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
