#pragma once

#include "slam/common/option_fields.h"

namespace aisle::slam {

/// Dense flow by inverse search of patches (DIS). Lengths are in pixels of the images given.
struct DenseFlowOptions {
  int finest_scale = 1;  ///< halvings of the image on which the finest patches lie
  int descents = 4;      ///< iterations of a patch on each scale
  /// What the coarser size says of a shift counts as much as a patch whose squared gradients, in
  /// grey levels per pixel, sum to this.
  double inertia = 60;
  int refinements = 2;  ///< variational iterations on each scale
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, DenseFlowOptions& options);

}  // namespace aisle::slam
