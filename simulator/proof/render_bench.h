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
/// machine; medians. Of several moments the first, which touches buffers for the first time, does
/// not count.
RenderBench BenchRender(const Studio& studio, std::span<const Moment> moments,
                        const RenderStages& render);

}  // namespace aisle::sim
