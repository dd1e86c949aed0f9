#pragma once

#include <cstddef>
#include <optional>

#include "simulator/world/world.h"

namespace aisle::sim {

/// Which light a shining triangle shows: the one whose rectangle is nearest to its middle. None
/// where that is farther than a lamp is deep: the sky shines by itself.
std::optional<std::size_t> LightShown(const World& world, std::size_t static_triangle);

}  // namespace aisle::sim
