#pragma once

#include <functional>
#include <optional>

#include "harness/contract/estimator.h"
#include "harness/contract/run.h"
#include "harness/contract/sequence.h"
#include "harness/run/mask_makers.h"

namespace aisle {

struct DriveOptions {
  std::size_t frames_ahead = 4;  ///< frames made ahead of the estimator
  /// Below this share of frames with a pose the run counts as lost.
  double min_coverage = kMinCoverage;
};

/// One frame as it passed: what was shown, what was said, and what came of it.
struct DrivenFrame {
  const FrameRequest& request;
  const SequenceFrame& shown;
  const FrameEstimate& estimate;
  const FrameFacts& facts;
  std::size_t index = 0;
  std::size_t count = 0;  ///< frames of the whole run
};
using FrameObserver = std::function<void(const DrivenFrame&)>;

/// Shows every frame of the sequence to the estimator, one after the other in lockstep, and keeps
/// the facts that the scores need. The estimator's exceptions end the run as kCrashed, poses that
/// are no finite rigid motions as kInvalid; the sequence's exceptions are not the system's fault
/// and pass through. Sets everything in the result but spec, scene_hash and threads.
RunResult Drive(const Sequence& sequence, Estimator& estimator, const MaskMaker& masks,
                const DriveOptions& options = {}, const FrameObserver& observer = {});

}  // namespace aisle
