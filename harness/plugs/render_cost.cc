#include "harness/plugs/render_cost.h"

#include "harness/plugs/open_simulator.h"
#include "simulator/proof/proofs.h"

namespace aisle {

RenderCost MeasureRender(const SimulatedSequenceOptions& options, int frames) {
  const sim::RenderBench bench = sim::BenchRender(OpenSimulator(options), frames);
  RenderCost cost{.pair_ms = bench.pair_ms,
                  .after_jump_ms = bench.after_jump_ms,
                  .bare_primary_ms = bench.bare_primary_ms,
                  .ratio = bench.ratio,
                  .frames = bench.frames,
                  .triangles = bench.triangles,
                  .moving_triangles = bench.moving_triangles,
                  .stage_ms = {bench.stage_ms.begin(), bench.stage_ms.end()}};
  std::ranges::sort(cost.stage_ms, std::greater<>{}, &std::pair<std::string, double>::second);
  return cost;
}

}  // namespace aisle
