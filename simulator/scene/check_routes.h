#pragma once

#include "simulator/scene/issues.h"

namespace aisle::sim {

/// Every route can be driven, keeps clear of what stands and of the rig: as written, and as each
/// of the usual seeds has it. One seed's first trouble is enough.
void CheckRoutes(const Scene& scene, Issues* issues);

/// The same for one seed alone.
void CheckRoutesOfSeed(const Scene& scene, std::uint64_t seed, Issues* issues);

}  // namespace aisle::sim
