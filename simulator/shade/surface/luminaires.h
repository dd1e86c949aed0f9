#pragma once

#include <cstddef>

#include "simulator/world/world.h"

namespace aisle::sim {

/// Which light a luminaire's triangle shows: the one whose rectangle is nearest to its middle.
std::size_t NearestLight(const World& world, std::size_t static_triangle);

}  // namespace aisle::sim
