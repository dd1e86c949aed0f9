#pragma once

#include <vector>

#include "harness/score/scorecard.h"

namespace aisle {

/// A track held against every frame that it should have answered, lost ones too.
struct FrameErrors {
  std::vector<std::int64_t> stamps_ns;  ///< rising
  std::vector<double> error_m;          ///< one per stamp; infinite where the track has no pose
};

/// Every true pose is a frame; with an interval, every step of that length which holds a true pose.
/// Which poses belong together comes from `score`.
FrameErrors ErrorsOverFrames(const Trajectory& truth, const TrajectoryScore& score,
                             std::int64_t interval_ns = 0);

/// The interval for files that do not tell the camera's rate: 0, or the estimate's median interval
/// where the truth is clearly denser (motion capture at 200 Hz, a camera at 20).
std::int64_t FrameIntervalNs(const Trajectory& truth, const Trajectory& estimate);

/// coverage, times_lost, recovery_max_s (from losing the track to the next pose) and the quantiles
/// error_all_{p50,p95}_m in which a lost frame counts as a failure: a system that gives up early
/// has a smaller error over the rest, and must not look better for it.
void AddCoverage(const FrameErrors& frames, const std::string& alignment, Scorecard* scores);

}  // namespace aisle
