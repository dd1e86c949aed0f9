#pragma once

#include <string>

#include "harness/record/group.h"

namespace aisle {

/// The absolute error of every system by the hall its runs were in; empty where all were in one.
std::string HallSection(const std::vector<SceneRuns>& scenes);

}  // namespace aisle
