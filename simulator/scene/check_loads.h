#pragma once

#include "simulator/scene/issues.h"

namespace aisle::sim {

/// Reports mechanisms that two hold, people at their ends or vehicles one after the other, where in
/// a drive one of the two may wait for the vehicle and the other not: each who yields keeps a time
/// of his own, and what they hold would come apart from them.
void CheckLoads(const Scene& scene, Issues* issues);

}  // namespace aisle::sim
