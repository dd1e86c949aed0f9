#pragma once

#include "simulator/scene/issues.h"

namespace aisle::sim {

/// Lights that move: where they are, when they turn, what they are called, keys of another kind.
void CheckBeams(const Scene& scene, Issues* issues);

}  // namespace aisle::sim
