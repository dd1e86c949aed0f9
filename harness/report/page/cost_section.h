#pragma once

#include <string>
#include <vector>

#include "harness/record/group.h"

namespace aisle {

/// The table of where the error comes from (SplitCosts); empty where there is nothing to split.
std::string CostSection(const std::vector<SceneRuns>& scenes);

}  // namespace aisle
