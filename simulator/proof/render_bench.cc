#include "simulator/proof/render_bench.h"

#include <algorithm>

#include "simulator/common/lap_watch.h"

namespace aisle::sim {
namespace {

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

RenderBench BenchRender(const Studio& studio, std::span<const FrameInDrive> frames,
                        const RenderStages& render) {
  std::vector<double> pair, after_jump, bare;
  std::map<std::string, std::vector<double>> stages;
  std::vector<HitImage> hits;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& [before, now] = frames[i];
    LapWatch watch;
    StageTimes jump_stages, frame_stages;
    render(static_cast<int>(i), before, &jump_stages);
    // The first touches buffers for the first time.
    if (const double jump_ms = watch.Lap(); i > 0) after_jump.push_back(jump_ms);
    const Instant instant = studio.At(now);
    const std::array<CameraView, 2> views = studio.Views(now);
    watch.Lap();
    TraceViews(instant, views, {.single_packets = true}, &hits);
    bare.push_back(watch.Lap());
    render(static_cast<int>(i), now, &frame_stages);
    pair.push_back(watch.Lap());
    for (const auto& [stage, ms] : frame_stages) stages[stage].push_back(ms);
  }
  RenderBench result{.pair_ms = Median(pair),
                     .after_jump_ms = Median(after_jump),
                     .bare_primary_ms = Median(bare),
                     .ratio = Median(pair) / Median(bare),
                     .frames = static_cast<int>(pair.size()),
                     .stage_ms = {}};
  for (const TriangleMesh& mesh : studio.world.mover_meshes()) {
    result.moving_triangles += std::ssize(mesh.triangles);
  }
  result.triangles = result.moving_triangles + std::ssize(studio.world.statics().mesh.triangles);
  for (auto& [stage, ms] : stages) result.stage_ms[stage] = Median(ms);
  return result;
}

}  // namespace aisle::sim
