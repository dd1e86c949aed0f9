#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>

#include "simulator/frames.h"
#include "simulator/proof/studio.h"

namespace aisle::sim {

/// Renders the index-th moment and adds the milliseconds of each stage.
using RenderStages =
    std::function<void(int index, const Moment& moment, std::map<std::string, double>* stages)>;

/// Times `render` and the bare primary rays of the same moments in turn, so that both meet the same
/// machine; medians. Each frame comes after the one before it, as in a drive, which is timed apart:
/// it came after a jump.
RenderBench BenchRender(const Studio& studio, std::span<const FrameInDrive> frames,
                        const RenderStages& render);

}  // namespace aisle::sim
