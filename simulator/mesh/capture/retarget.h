#pragma once

#include "simulator/mesh/capture/bvh.h"
#include "simulator/mesh/model.h"

namespace aisle::sim {

struct RetargetOptions {
  /// The skeleton as its offsets draw it is taken for the pose in which it and the model agree if
  /// its limbs lie no further than this, in the mean, from the model's; else the frame that lies
  /// nearest. Arms that hang where the model's are stretched are 90 degrees off.
  double agreement_rad = 0.7;
  double still_mps = 0.25;  ///< a foot this slow and
  double low_m = 0.06;      ///< this near to its lowest stands
  double blend_s = 0.12;    ///< over which a foot comes to its place and leaves it
};

/// What a recorded motion became on a model.
struct Retargeted {
  /// Moves the model's nodes, at the recording's own frames; the pelvis as well, on the floor of
  /// the model's frame: in the first frame it is above the origin and faces x.
  Clip clip;
  /// Frames during which a foot stands, left and right, first and last of each.
  std::array<std::vector<std::array<std::size_t, 2>>, 2> contacts;
};

/// Lays a recorded motion onto a model with the skeleton of assets/people. Which way is up and
/// ahead is told from the body itself, its size from its legs, so that the file's unit does not
/// matter. Each bone points where the recorded one does and turns about itself as that one does.
/// While a foot stands its ball keeps its place on the floor, and the leg follows. Throws
/// ImportError where a body cannot be found in the recording.
Retargeted Retarget(const Bvh& bvh, const Model& model, const RetargetOptions& options = {});

}  // namespace aisle::sim
