#pragma once

#include <functional>

#include "harness/contract/run.h"
#include "harness/contract/sequence.h"
#include "harness/run/drive.h"

namespace aisle {

/// What a system that ran elsewhere says of a frame beside its pose: keypoints, a mask. May throw.
using Remarks = std::function<FrameEstimate(const StereoFrame&)>;

/// Shows a drive that is over to the truth, frame by frame: `result` has the poses, `remarks` the
/// rest. Fills in what only truth knows (what moves, how hard the frames are, features and masks
/// against it) and calls the observer as Drive does; poses, status and times stay as they are. What
/// goes wrong becomes a note and leaves the result as it was.
void PlayBack(const Sequence& sequence, const Remarks& remarks, const FrameObserver& observer,
              RunResult* result);

/// Says that each frame took its share of the whole: all that is known of a system whose steps
/// nobody saw.
void SpreadWallTime(RunResult* result);

}  // namespace aisle
