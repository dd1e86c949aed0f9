#pragma once

#include "simulator/scene/issues.h"

namespace aisle::sim {

/// What no single value can show: routes that leave the hall, run through racks or cannot be
/// driven (by any of the usual seeds), names used twice, boxes turned inside out.
void CheckScene(const Scene& scene, Issues* issues);

}  // namespace aisle::sim
