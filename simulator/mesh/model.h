#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "simulator/mesh/material.h"
#include "simulator/mesh/triangle_mesh.h"

namespace aisle::sim {

/// Position, rotation and size of a node in its parent, kept apart so that poses can be blended.
struct NodePose {
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();
};

struct ModelNode {
  std::string name;
  int parent = -1;  ///< index of the parent, always smaller than its own; -1: the root
  NodePose rest;    ///< in the parent
};
inline constexpr std::size_t kMostModelNodes = 100'000;  ///< of a model

/// One of the frames a vertex may follow: a node, and where the vertex's bind position lies in it.
struct ModelJoint {
  int node = 0;
  Eigen::Affine3f bind_to_node = Eigen::Affine3f::Identity();
};

/// The joints that carry a vertex, heaviest first; the weights sum to 1, unused ones are 0.
struct VertexWeights {
  std::array<std::uint16_t, 4> joints = {0, 0, 0, 0};
  std::array<float, 4> weights = {1, 0, 0, 0};
};

/// What a value does between two keys (glTF 2.0, appendix C): keep the first, go straight
/// (rotations along the great circle), or follow a cubic Hermite spline.
enum class Interpolation { kStep, kLinear, kCubic };

/// A value over time; times in seconds, rising. No keys: the rest pose's value.
template <class Value>
struct KeyCurve {
  std::vector<std::pair<float, Value>> keys;
  Interpolation interpolation = Interpolation::kLinear;
  /// For kCubic: the slopes into and out of each key, a second (of rotations: of the coefficients).
  std::vector<std::array<Value, 2>> slopes;
};

/// What a clip does to one node.
struct ClipChannel {
  int node = 0;
  KeyCurve<Eigen::Vector3f> translations;
  KeyCurve<Eigen::Quaternionf> rotations;
  KeyCurve<Eigen::Vector3f> scales;
};

struct Clip {
  std::string name;
  float duration_s = 0;
  std::vector<ClipChannel> channels;
};

/// Materials and textures of one band of a coloured model.
struct ModelSurfaces {
  std::vector<Material> materials;
  std::vector<Texture> textures;
};

/// An imported file: all its meshes as one, each vertex following up to four joints. A rigid part
/// is a vertex that follows one node. Coordinates are those of `ImportOptions::frame`.
struct Model {
  std::string name;                             ///< the file's stem
  TriangleMesh mesh;                            ///< in the rest pose
  std::vector<Eigen::Vector3f> bind_positions;  ///< per vertex, as the joints expect them
  std::vector<Eigen::Vector3f> bind_normals;
  std::vector<VertexWeights> weights;  ///< per vertex
  std::vector<ModelJoint> joints;
  std::vector<ModelNode> nodes;  ///< parents before children
  std::vector<Clip> clips;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  /// Red, green and blue, if they were asked for: like materials and textures but for the band.
  std::vector<ModelSurfaces> colour;
  /// What the file has and the model has not, each a phrase: "2 cameras".
  std::vector<std::string> left_out;

  /// Index by name, -1 if there is none; the first where several bear it.
  int FindNode(const std::string& name) const;
  int FindClip(const std::string& name) const;
};

}  // namespace aisle::sim
