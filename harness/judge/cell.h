#pragma once

#include <string>
#include <tuple>

#include "harness/contract/run.h"

namespace aisle {

/// What the runs of a night have in common that differ by seed alone: scene, twin, system.
using CellOfNight = std::tuple<std::string, std::string, std::string>;

inline CellOfNight CellOf(const RunSpec& spec) { return {spec.scene, spec.twin, spec.system.name}; }

}  // namespace aisle
