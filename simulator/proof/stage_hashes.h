#pragma once

#include "simulator/frames.h"
#include "simulator/proof/proofs.h"
#include "simulator/studio.h"

namespace aisle::sim {

/// Hashes of what the stages make of a moment; `frame` is its pair, as the pipeline rendered it.
StageHashes HashStages(const Studio& studio, const Moment& moment, const RenderedFrame& frame);

}  // namespace aisle::sim
