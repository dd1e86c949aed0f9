#pragma once

#include <functional>
#include <span>

#include "simulator/pipeline.h"
#include "simulator/proof/proofs.h"
#include "simulator/studio.h"

namespace aisle::sim {

/// A frame of a drive and the one before it.
struct FrameInDrive {
  Moment before, now;
};

/// Renders the index-th moment and adds the milliseconds of each stage.
using RenderStages = std::function<void(int index, const Moment& moment, StageTimes* stages)>;

/// Times `render` and the bare primary rays of the same moments in turn, so that both meet the same
/// machine; medians. Each frame comes after the one before it, as in a drive, which is timed apart:
/// it came after a jump.
RenderBench BenchRender(const Studio& studio, std::span<const FrameInDrive> frames,
                        const RenderStages& render);

}  // namespace aisle::sim
