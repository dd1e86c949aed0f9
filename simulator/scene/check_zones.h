#pragma once

#include "simulator/scene/issues.h"

namespace aisle::sim {

/// The planned way of a closed drive keeps to the rules of its zones. The route must be one that
/// can be driven.
void CheckZones(const Scene& scene, Issues* issues);

}  // namespace aisle::sim
