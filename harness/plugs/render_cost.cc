#include "harness/plugs/render_cost.h"

#include "harness/io/input_error.h"
#include "harness/plugs/open_simulator.h"

namespace aisle {

RenderCost MeasureRender(const SimulatedSequenceOptions& options, int frames) {
  const sim::RenderBench bench = OpenSimulator(options).Bench(frames);
  RenderCost cost{.pair_ms = bench.pair_ms,
                  .bare_primary_ms = bench.bare_primary_ms,
                  .ratio = bench.ratio,
                  .frames = bench.frames,
                  .stage_ms = {bench.stage_ms.begin(), bench.stage_ms.end()}};
  std::ranges::sort(cost.stage_ms, std::greater<>{}, &std::pair<std::string, double>::second);
  return cost;
}

LightComparison CompareLight(const SimulatedSequenceOptions& options, int frame, int samples,
                             int reduce) {
  const sim::Simulator simulator = OpenSimulator(options);
  const int count = simulator.frame_count();
  if (frame >= count) {
    throw InputError(
        fmt::format("frame {}: {} has frames 0 to {}", frame, options.scene_name, count - 1));
  }
  const int chosen = frame >= 0 ? frame : count / 2;
  sim::LightCheck check = simulator.CheckLight(chosen, samples, reduce);
  return {.frame = chosen,
          .nightly = std::move(check.nightly),
          .reference = std::move(check.reference),
          .median_relative_error = check.median_relative_error,
          .ssim = check.ssim,
          .mean_ratio = check.mean_ratio,
          .noise_median_relative = check.noise_median_relative,
          .noise_ssim = check.noise_ssim};
}

}  // namespace aisle
