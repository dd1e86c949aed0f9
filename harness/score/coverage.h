#pragma once

#include <vector>

#include "harness/score/scorecard.h"

namespace aisle {

/// A track held against every frame that it should have answered, lost ones too.
struct FrameErrors {
  std::vector<std::int64_t> stamps_ns;  ///< rising
  /// One per stamp: infinite where the track has no pose, NaN where it has one that no truth is
  /// near.
  std::vector<double> error_m;
};

/// Of a run: every true pose is a frame, one without a pose of the track is lost. Which poses
/// belong together comes from `score`; where its alignment leaves no errors, those that have a pose
/// are not judged.
FrameErrors ErrorsOverFrames(const Trajectory& truth, const TrajectoryScore& score);

/// Of two files, neither of which lists the camera's frames. The frames are the rows of the slower
/// file, and what is lost is told by the estimate's stamps alone, never by gaps of the truth:
/// - Truth is no denser than the estimate (within half as much): its rows are the frames; one is
///   lost where no pose is within three quarters of the estimate's median interval.
/// - Truth is denser (motion capture): the estimate's poses are the frames, and those of its median
///   interval that fit into a hole of it, or between an end of it and the truth's, where they are
///   three or more. Fewer may be pictures that the camera dropped.
/// - A camera's interval is given (not 0): as the second, with that interval and from one frame on.
///
/// A frame that has a pose and no truth near is not judged. Where pairs are by index, and where
/// less than half of the shorter file could be paired and the alignment leaves no errors or stamps
/// seem of another unit, it is as in ErrorsOverFrames: such stamps tell of no frames.
FrameErrors ErrorsOverFiles(const Trajectory& truth, const Trajectory& estimate,
                            const TrajectoryScore& score, const AssociationOptions& association,
                            std::int64_t interval_ns = 0);

/// coverage, times_lost, recovery_max_s (from losing the track to the next pose) and the quantiles
/// error_all_{p50,p95}_m in which a lost frame counts as a failure: a system that gives up early
/// has a smaller error over the rest, and must not look better for it. Frames that are not judged
/// count as covered, and for no quantile.
void AddCoverage(const FrameErrors& frames, const std::string& alignment, Scorecard* scores);

/// The same of two files, by ErrorsOverFiles; `score` is ScoreTrajectory's. Its notes then say how
/// many poses are not judged, and how many frames count as lost before the estimate begins and
/// after it ends. rate_hz is the camera's; 0: not known.
void AddCoverageOfFiles(const Trajectory& truth, const Trajectory& estimate,
                        const ScoreOptions& options, double rate_hz, TrajectoryScore* score);

}  // namespace aisle
