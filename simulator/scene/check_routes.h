#pragma once

#include "simulator/scene/floor_way.h"
#include "simulator/scene/issues.h"

namespace aisle::sim {

/// Every route can be driven, keeps clear of what stands and of the rig: as written, and as each
/// of the usual seeds has it. One seed's first trouble is enough. Of who moves as recorded only the
/// start is looked at, unless `ways` says where they go.
void CheckRoutes(const Scene& scene, Issues* issues, const FloorWays& ways = {});

/// The same for one seed alone.
void CheckRoutesOfSeed(const Scene& scene, std::uint64_t seed, Issues* issues,
                       const FloorWays& ways = {});

}  // namespace aisle::sim
