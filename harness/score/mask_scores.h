#pragma once

#include <vector>

#include "harness/contract/run.h"

namespace aisle {

/// mask_* over all pixels together, object_* by rectangle and by what was covered, mover_* over
/// time, static_features_lost. Nothing at all where no frame has mask facts.
void AddMasks(const std::vector<FrameFacts>& frames, Scorecard* scores);

}  // namespace aisle
