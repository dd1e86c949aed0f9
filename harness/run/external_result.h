#pragma once

#include "harness/contract/run.h"

namespace aisle {

/// The run of a system that left one trajectory and nothing else. Frames are those of the truth; a
/// frame has a pose where the estimate has one within half a frame (one to one). Live and final
/// track are the same: nobody says what was known when. Lost below `min_coverage`; else invalid
/// where less than half of the poses, or of the frames if these are fewer, belong to another: their
/// stamps are not the frames'. Such stamps are told as the system saw them, `epoch_ns` later.
RunResult ResultFromTrajectory(const Trajectory& truth, const Trajectory& estimate,
                               double min_coverage = kMinCoverage, std::int64_t epoch_ns = 0);

}  // namespace aisle
