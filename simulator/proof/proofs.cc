#include "simulator/proof/proofs.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include "simulator/pipeline.h"
#include "simulator/proof/light_proof.h"
#include "simulator/proof/picture_in_time.h"
#include "simulator/proof/render_bench.h"
#include "simulator/proof/stage_hashes.h"
#include "simulator/proof/truth_proof.h"
#include "simulator/simulator.h"

namespace aisle::sim {
namespace {

/// When and from where a frame is taken on the scene's route.
Moment PlannedMoment(const Simulator& simulator, int frame_index) {
  const std::int64_t stamp_ns = simulator.Stamp(frame_index);
  return {stamp_ns, simulator.PlannedPose(stamp_ns)};
}

void ExpectPositive(const char* name, int count) {
  if (count > 0) return;
  throw std::invalid_argument(fmt::format("{} = {}: expected more than 0", name, count));
}

/// What `prove` says of the simulator's parts, on the simulator's threads.
template <typename Prove>
auto OnItsThreads(const Simulator& simulator, const Moment& moment, const Prove& prove) {
  const Pipeline& pipeline = simulator.pipeline();
  const Studio studio = pipeline.StudioAt(moment);
  std::invoke_result_t<const Prove&, const Studio&> result{};
  pipeline.Execute([&] { result = prove(studio); });
  return result;
}

}  // namespace

std::string VerifyReport::failure() const {
  constexpr double kAgreement = 0.999, kWarp = 0.05;
  constexpr double kLeastRaster = 0.1, kLeastWarped = 0.01;  // of what could be compared
  if (raster_compared < kLeastRaster * raster_pixels || raster_compared == 0) {
    return fmt::format(
        "depth and labels could be held against the rasteriser on {} of {} pixels "
        "only, which proves nothing",
        raster_compared, raster_pixels);
  }
  const double agreement = std::min(raster_agreement_left, raster_agreement_right);
  if (agreement < kAgreement) {
    return fmt::format("depth and labels agree with the rasteriser on {:.3f} % of {} pixels only",
                       100 * agreement, raster_compared);
  }
  if (stereo_compared < kLeastWarped * surface_pixels) {
    return fmt::format(
        "left could be warped to right on {} of {} pixels only, which proves nothing",
        stereo_compared, surface_pixels);
  }
  if (stereo_median_px > kWarp) {
    return fmt::format("left warps to right with a median error of {:.3f} px", stereo_median_px);
  }
  if (flow_compared < kLeastWarped * surface_pixels) {
    return fmt::format(
        "flow could be held against the next frame on {} of {} pixels only, which proves nothing",
        flow_compared, surface_pixels);
  }
  if (flow_median_px > kWarp) {
    return fmt::format("flow misses the next frame by a median of {:.3f} px", flow_median_px);
  }
  return picture_failure;
}

VerifyReport Verify(const Simulator& simulator, int frame_index) {
  const std::array moments = {PlannedMoment(simulator, frame_index),
                              PlannedMoment(simulator, frame_index + 1),
                              PlannedMoment(simulator, frame_index + 2)};
  return OnItsThreads(simulator, moments[0], [&](const Studio& studio) {
    VerifyReport report = ProveTruth(studio, moments[0], moments[1]);
    const PictureChanges changes = CompareInTime(studio, moments);
    report.static_change_grey = changes.statics.rms;
    report.mover_flicker_grey = changes.movers.flicker;
    report.shadow_flicker_grey = changes.shadows.flicker;
    report.picture_failure = FailureOf(changes);
    return report;
  });
}

RenderBench BenchRender(const Simulator& simulator, int frames) {
  ExpectPositive("frames", frames);
  std::vector<FrameInDrive> spread;
  for (int i = 0; i < frames; ++i) {
    const int frame = static_cast<int>(std::int64_t{simulator.frame_count() - 1} * i / frames);
    spread.push_back(
        {PlannedMoment(simulator, std::max(0, frame - 1)), PlannedMoment(simulator, frame)});
  }
  return OnItsThreads(simulator, spread.front().now, [&](const Studio& studio) {
    return BenchRender(studio, spread, [&](int index, const Moment& moment, StageTimes* stages) {
      simulator.pipeline().RenderTimed(index, moment, stages);
    });
  });
}

StageHashes HashStages(const Simulator& simulator, int frame_index) {
  const Moment moment = PlannedMoment(simulator, frame_index);
  const RenderedFrame frame = simulator.Render(frame_index, moment.stamp_ns, moment.T_world_rig);
  return OnItsThreads(simulator, moment,
                      [&](const Studio& studio) { return HashStages(studio, moment, frame); });
}

LightCheck CheckLight(const Simulator& simulator, int frame_index, int samples, int reduce) {
  ExpectPositive("samples", samples);
  ExpectPositive("reduce", reduce);
  const Moment moment = PlannedMoment(simulator, frame_index);
  return OnItsThreads(simulator, moment, [&](const Studio& studio) {
    return CheckLight(studio, moment, samples, reduce);
  });
}

LightChangeCheck CheckLightChange(const Simulator& simulator, int frame_index, int samples,
                                  int reduce) {
  ExpectPositive("samples", samples);
  ExpectPositive("reduce", reduce);
  const std::array moments = {PlannedMoment(simulator, frame_index),
                              PlannedMoment(simulator, frame_index + 1)};
  return OnItsThreads(simulator, moments[0], [&](const Studio& studio) {
    return CheckLightChange(studio, moments, samples, reduce);
  });
}

}  // namespace aisle::sim
