#pragma once

#include <cstdint>
#include <functional>

#include "harness/contract/estimator.h"
#include "harness/contract/mask_errors.h"
#include "harness/contract/sequence.h"

namespace aisle {

/// What an estimator is handed besides the images of a frame. Called once per frame, in order.
using MaskMaker = std::function<ExternalMask(const SequenceFrame&)>;

/// Truth's own masks. Both images empty for kNone or where truth is not known.
MaskMaker MasksFromTruth(MaskSource source);

/// Truth's masks as an imperfect network would give them. Errors are drawn from (seed, frame,
/// object) alone: the same run gives the same masks. A missed object is missed in both cameras.
/// Without any error they are truth's own.
MaskMaker MasksWithErrors(MaskSource source, const MaskErrors& errors, std::uint64_t seed);

/// A mask handed over is the system's mask, unless it says otherwise.
void AdoptMask(const ExternalMask& mask, FrameEstimate* estimate);

}  // namespace aisle
