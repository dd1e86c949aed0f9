#pragma once

#include <Eigen/Geometry>

#include "simulator/mesh/pose.h"

namespace aisle::sim {

/// A leg: three nodes below one another.
struct Limb {
  int upper = -1, lower = -1, end = -1;
};

/// Applies a motion to a node and all below it. Parents come before children.
void MoveSubtree(const Model& model, int top, const Eigen::Affine3f& motion, NodeFrames* frames);

/// Brings the limb's end to a frame in the model by turning the upper and lower node; the middle
/// joint bends in the plane it bends in already. A target out of reach is approached as far as
/// `reach` (a share of the stretched limb) allows. `frames` are changed, with all that hangs below.
void ReachFor(const Model& model, const Limb& limb, const Eigen::Affine3f& target, float reach,
              NodeFrames* frames);

}  // namespace aisle::sim
