#pragma once

#include <cstdint>
#include <string>

#include "simulator/simulator.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// Hash of all that decides a world's pixels: what the scene says (EssenceOfScene), what was made
/// of it, the files it was made from, and what may be asked of it. Where the movers are is asked at
/// the start and in the middle; between these the scene and the models' files decide.
std::uint64_t ContentHash(const std::string& essence, const World& world, std::int64_t end_ns,
                          const SimulatorOptions& options);

}  // namespace aisle::sim
