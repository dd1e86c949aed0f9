#pragma once

#include "simulator/scene/issues.h"

namespace aisle::sim {

/// Reports what no mechanism can be: joints without their keys, parts on parts that are not there,
/// people and forks that nobody is.
void CheckMechanisms(const Scene& scene, Issues* issues);

}  // namespace aisle::sim
