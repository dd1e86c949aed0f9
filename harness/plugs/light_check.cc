#include "harness/plugs/light_check.h"

#include "harness/io/input_error.h"
#include "harness/plugs/open_simulator.h"
#include "simulator/proof/proofs.h"

namespace aisle {
namespace {

LightComparison::Change ChangeOf(const sim::LightChangeCheck::Part& part) {
  return {part.pixels,      part.rms_rendered, part.rms_reference,
          part.rms_between, part.rms_noise,    part.correlation};
}

LightComparison ComparisonOf(int frame, sim::LightCheck check) {
  return {.frame = frame,
          .nightly = std::move(check.rendered),
          .reference = std::move(check.reference),
          .median_relative_error = check.median_relative_error,
          .ssim = check.ssim,
          .mean_ratio = check.mean_ratio,
          .noise_median_relative = check.noise_median_relative,
          .noise_ssim = check.noise_ssim,
          .everywhere = std::nullopt,
          .on_movers = std::nullopt};
}

}  // namespace

LightComparison CompareLight(const SimulatedSequenceOptions& scene,
                             const LightComparisonOptions& options) {
  const sim::Simulator simulator = OpenSimulator(scene);
  const int last = simulator.frame_count() - (options.next ? 2 : 1);
  if (options.frame > last) {
    throw InputError(fmt::format("frame {}: {} has frames 0 to {}{}", options.frame,
                                 scene.scene_name, last, options.next ? " with a next one" : ""));
  }
  const int frame = options.frame >= 0 ? options.frame : simulator.frame_count() / 2;
  if (!options.next) {
    return ComparisonOf(frame, sim::CheckLight(simulator, frame, options.samples, options.reduce));
  }
  sim::LightChangeCheck check =
      sim::CheckLightChange(simulator, frame, options.samples, options.reduce);
  LightComparison comparison = ComparisonOf(frame, std::move(check.now));
  comparison.everywhere = ChangeOf(check.everywhere);
  comparison.on_movers = ChangeOf(check.on_movers);
  return comparison;
}

cv::Mat3f TraceForeignPicture(const std::string& file, const ForeignPictureOptions& options) {
  try {
    return sim::TraceForeignScene(
        file, {.samples = options.samples, .depth = options.depth, .threads = options.threads});
  } catch (const std::system_error& error) {  // no memory, no process to read a model in
    throw MachineError(error.what());
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

}  // namespace aisle
