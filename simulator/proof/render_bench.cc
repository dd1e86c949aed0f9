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

RenderBench BenchRender(const Studio& studio, std::span<const Moment> moments,
                        const RenderStages& render) {
  std::vector<double> pair, bare;
  std::map<std::string, std::vector<double>> stages;
  std::vector<HitImage> hits;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Instant instant = studio.At(moments[i]);
    const std::array<CameraView, 2> views = studio.Views(moments[i]);
    LapWatch watch;
    TraceViews(instant, views, {.single_packets = true}, &hits);
    const double bare_ms = watch.Lap();
    std::map<std::string, double> frame_stages;
    watch.Lap();
    render(static_cast<int>(i), moments[i], &frame_stages);
    const double pair_ms = watch.Lap();
    if (i == 0 && moments.size() > 1) continue;
    bare.push_back(bare_ms);
    pair.push_back(pair_ms);
    for (const auto& [stage, ms] : frame_stages) stages[stage].push_back(ms);
  }
  RenderBench result{.pair_ms = Median(pair),
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
