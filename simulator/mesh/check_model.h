#pragma once

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// What every model keeps to that reaches the renderer, whoever made it: lists of the same length
/// where they belong together, every index of something that is there, parents before their
/// children, all numbers finite, textures of the options' size, and no vertex further than
/// ImportOptions::max_reach_m from the origin, at rest or at one of the times looked at in a clip.
/// Throws ImportError that names what is broken.
void CheckModel(const Model& model, const ImportOptions& options);

}  // namespace aisle::sim
