#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "simulator/mesh/model.h"

namespace aisle::sim {

/// A clip at a time, mixed in with a weight.
struct PoseLayer {
  int clip = -1;        ///< index into Model::clips; -1: the rest pose
  double time_s = 0;    ///< wrapped into the clip's duration
  float weight = 1;     ///< ≥ 0, relative to the other layers
  int below_node = -1;  ///< ≥ 0: acts only on this node and those below it, over the others, weight
                        ///< then being its opacity in [0, 1]
};

/// Moves a node in its own axes, after the clips: a wheel that rolls, a mast that lifts.
struct NodeMove {
  int node = 0;
  Eigen::Affine3f in_node = Eigen::Affine3f::Identity();
};

/// Frame of every node in the model: T_model_node.
using NodeFrames = std::vector<Eigen::Affine3f>;

/// Whether a matrix is a pose's translation, rotation and scale: to a thousandth of the largest
/// entry of its linear part. One with shear is that of no pose.
bool IsComposedOf(const Eigen::Matrix4f& matrix, const NodePose& pose);

/// Local pose of every node with the layers blended.
std::vector<NodePose> BlendLayers(const Model& model, std::span<const PoseLayer> layers);

/// Chains local poses, parents first.
NodeFrames FramesOf(const Model& model, std::span<const NodePose> locals,
                    std::span<const NodeMove> moves);

/// Both in one: the model's nodes with layers blended and moves applied.
NodeFrames PoseNodes(const Model& model, std::span<const PoseLayer> layers,
                     std::span<const NodeMove> moves = {});

/// Matrix of each joint: bind position -> model frame.
std::vector<Eigen::Affine3f> JointMatrices(const Model& model, const NodeFrames& frames);

/// Linear blend skinning. Outputs are resized to the model's vertices; normals are renormalised
/// (and follow the inverse transpose where a joint scales one axis more than another).
void SkinVertices(const Model& model, std::span<const Eigen::Affine3f> joint_matrices,
                  std::vector<Eigen::Vector3f>* positions, std::vector<Eigen::Vector3f>* normals);

/// Only where the vertices are: Σ w M v, for matrices that need not be rigid (velocities are the
/// same sum with the matrices' time derivatives).
void BlendVertices(const Model& model, std::span<const Eigen::Affine3f> joint_matrices,
                   std::vector<Eigen::Vector3f>* positions);

}  // namespace aisle::sim
