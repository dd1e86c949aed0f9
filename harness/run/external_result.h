#pragma once

#include "harness/contract/run.h"

namespace aisle {

/// The run of a system that left one trajectory and nothing else. Frames are those of the truth; a
/// frame has a pose where the estimate has one within half a frame (one to one). Live and final
/// track are the same: nobody says what was known when. Lost below `min_coverage`.
RunResult ResultFromTrajectory(const Trajectory& truth, const Trajectory& estimate,
                               double min_coverage = kMinCoverage);

}  // namespace aisle
