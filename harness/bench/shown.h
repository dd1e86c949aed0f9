#pragma once

#include <memory>

#include "harness/bench/source.h"
#include "harness/contract/estimator.h"
#include "harness/contract/forwarding_sequence.h"
#include "harness/contract/system_spec.h"
#include "harness/run/mask_makers.h"

namespace aisle {

// Benches show a system what a run shows it: the images, the masks of what moves where it is told
// them, and what the wheels measured where it asks for that.

/// As OpenSource, with what the wheels measured where the system is handed it. Throws InputError,
/// also where nobody knows the way.
std::unique_ptr<Sequence> OpenSourceFor(const SystemSpec& system, const BenchView& view,
                                        const BenchSource& source);

/// What the system is handed besides the images, asked for every frame that it is shown, in order.
/// Throws InputError for a frame whose truth does not say what the system is told.
MaskMaker MasksFor(const SystemSpec& system, const BenchView& view, const BenchSource& source);

/// What the system says of a frame. A mask handed over is its mask, unless it says otherwise.
FrameEstimate Show(const SequenceFrame& frame, const MaskMaker& masks, Estimator* estimator);

/// Some frames of another sequence, which must outlive it: from one on, `to` not included. Nobody
/// measured a motion before the first.
class Excerpt : public ForwardingSequence {
 public:
  Excerpt(const Sequence& whole, int from, int to)
      : ForwardingSequence(whole), from_(from), to_(to) {}

  std::vector<FrameRequest> Schedule() const override;
  SequenceFrame At(const FrameRequest& request) const override;

 private:
  int from_, to_;
};

}  // namespace aisle
