#include "harness/plugs/simulated_sequence.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "harness/contract/twin.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/plugs/ask_simulator.h"
#include "harness/plugs/bag_poses.h"
#include "harness/plugs/open_simulator.h"
#include "harness/plugs/simulated_frame.h"
#include "simulator/proof/proofs.h"
#include "simulator/scene_file.h"
#include "simulator/site.h"

namespace aisle {
namespace {

struct NamedTwin {
  std::string_view name;
  sim::Twin twin;
};
constexpr std::array kTwins = {NamedTwin{twin::kLive, sim::Twin::kLive},
                               NamedTwin{twin::kEmpty, sim::Twin::kEmpty},
                               NamedTwin{twin::kFrozen, sim::Twin::kFrozen},
                               NamedTwin{"none", sim::Twin::kNone},
                               NamedTwin{"low", sim::Twin::kLow},
                               NamedTwin{"mid", sim::Twin::kMid},
                               NamedTwin{"high", sim::Twin::kHigh}};

sim::Twin TwinFromName(const std::string& name) {
  const auto twin = std::ranges::find(kTwins, name, &NamedTwin::name);
  if (twin != kTwins.end()) return twin->twin;
  throw InputError(
      fmt::format("twin '{}': expected one of {}", Printable(name), fmt::join(TwinNames(), ", ")));
}

class SimulatedSequence : public Sequence {
 public:
  SimulatedSequence(sim::Simulator simulator, std::string name)
      : simulator_(std::move(simulator)), name_(std::move(name)) {}

  std::string name() const override { return name_; }

  StereoCalibration calibration() const override { return CalibrationOf(simulator_.rig()); }

  double rate_hz() const override { return simulator_.rate_hz(); }

  std::vector<FrameRequest> Schedule() const override {
    std::vector<FrameRequest> schedule;
    for (int k = 0; k < simulator_.frame_count(); ++k) {
      const std::int64_t stamp_ns = simulator_.Stamp(k);
      schedule.push_back({k, stamp_ns, simulator_.PlannedPose(stamp_ns)});
    }
    return schedule;
  }

  PathOfRig Path() const {
    return [this](std::int64_t stamp_ns) { return simulator_.PlannedPose(stamp_ns); };
  }

  const sim::Simulator& simulator() const { return simulator_; }

  FrameMotion MotionOf(const FrameRequest& request) const {
    const std::int64_t next_ns = simulator_.Stamp(static_cast<int>(request.id) + 1);
    return MotionBetween(request, {request.id + 1, next_ns, simulator_.PlannedPose(next_ns)});
  }

  FrameMotion MotionBetween(const FrameRequest& from, const FrameRequest& to) const {
    sim::MotionTruth truth =
        simulator_.RenderMotion(from.stamp_ns, from.T_world_rig, to.stamp_ns, to.T_world_rig);
    return {truth.disparity, truth.occluded, truth.flow, truth.scene_flow, truth.moving_shadow};
  }

  FrameProof Prove(const FrameRequest& request) const {
    const sim::VerifyReport report = sim::Verify(simulator_, static_cast<int>(request.id));
    return {
        .raster_agreement = std::min(report.raster_agreement_left, report.raster_agreement_right),
        .stereo_median_px = report.stereo_median_px,
        .flow_median_px = report.flow_median_px,
        .static_change_grey = report.static_change_grey,
        .mover_flicker_grey = report.mover_flicker_grey,
        .shadow_flicker_grey = report.shadow_flicker_grey,
        .failure = report.failure()};
  }

  SequenceFrame At(const FrameRequest& request) const override {
    return FrameOf(
        request.id,
        simulator_.Render(static_cast<int>(request.id), request.stamp_ns, request.T_world_rig),
        simulator_.instances());
  }

 private:
  sim::Simulator simulator_;
  std::string name_;
};

}  // namespace

const std::vector<std::string>& TwinNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const NamedTwin& one : kTwins) all.emplace_back(one.name);
    return all;
  }();
  return names;
}

namespace {

std::function<void(const sim::LightProgress&)> TellerOf(const SimulatedSequenceOptions& options) {
  const auto teller = std::make_shared<LightTeller>(options.scene_name, options.light_progress);
  return [teller](const sim::LightProgress& at) { teller->Tell(at.phase, at.share); };
}

/// What of a scene is asked for, over what systems are shown.
struct Shown {
  std::string pair = {};
  bool colour = false;
};

sim::Simulator Open(const SimulatedSequenceOptions& options, const Shown& shown) {
  const sim::Twin twin = TwinFromName(options.twin);
  return AskSimulator([&] {
    return sim::Simulator::Load(options.scene_file, options.assets_dir,
                                {.seed = options.seed,
                                 .twin = twin,
                                 .pair = shown.pair,
                                 .colour = shown.colour,
                                 .threads = options.threads,
                                 .isa = options.isa,
                                 .light_spacing = options.light_spacing,
                                 .light_progress = TellerOf(options),
                                 .bags = ReadPosesOfBag});
  });
}

}  // namespace

sim::Simulator OpenSimulator(const SimulatedSequenceOptions& options) { return Open(options, {}); }

void RefuseLens(const sim::Simulator& simulator, const SimulatedSequenceOptions& options) {
  const std::string& lens = simulator.rig().distortion_model;
  if (lens != "none" && !options.any_lens) {
    throw InputError(options.scene_file, 0,
                     "camera.distortion is " + lens +
                         ", but a run needs rectified pairs: `aisle render` it as euroc and run "
                         "`aisle slam` on that, which rectifies, or set it to none");
  }
}

std::unique_ptr<Sequence> OpenSimulation(const SimulatedSequenceOptions& options,
                                         std::uint64_t* content_hash, PathOfRig* path) {
  sim::Simulator simulator = OpenSimulator(options);
  RefuseLens(simulator, options);
  if (content_hash != nullptr) *content_hash = simulator.content_hash();
  auto sequence = std::make_unique<SimulatedSequence>(std::move(simulator), options.scene_name);
  if (path != nullptr) *path = sequence->Path();
  return sequence;
}

SimulationForExport OpenForExport(const SimulatedSequenceOptions& options,
                                  const std::string& pair) {
  const Shown shown{.pair = pair, .colour = true};
  auto sequence = std::make_unique<SimulatedSequence>(Open(options, shown), options.scene_name);
  const SimulatedSequence* at = sequence.get();
  const sim::RigInfo& rig = at->simulator().rig();
  SimulationForExport result;
  result.content_hash = at->simulator().content_hash();
  result.lens = {rig.distortion_model, rig.distortion};
  for (const sim::InstanceInfo& instance : at->simulator().instances()) {
    result.labels.push_back(
        {instance.name, instance.object_class, instance.class_id, instance.is_actor});
  }
  result.T_base_rig = at->simulator().site().Mount();
  if (at->simulator().has_colour()) {
    result.colour = [at](const FrameRequest& frame) {
      return at->simulator().RenderColour(static_cast<int>(frame.id), frame.stamp_ns,
                                          frame.T_world_rig);
    };
  }
  result.pair = at->simulator().pair();
  result.path = at->Path();
  result.motion = [at](const FrameRequest& frame) { return at->MotionOf(frame); };
  result.motion_between = [at](const FrameRequest& from, const FrameRequest& to) {
    return at->MotionBetween(from, to);
  };
  result.prove = [at](const FrameRequest& frame) { return at->Prove(frame); };
  result.sequence = std::move(sequence);
  return result;
}

std::function<cv::Mat1f(const FrameRequest&)> OpenDepth(const SimulatedSequenceOptions& options) {
  const auto simulator = std::make_shared<const sim::Simulator>(OpenSimulator(options));
  return [simulator](const FrameRequest& frame) {
    return simulator->RenderDepth(frame.stamp_ns, frame.T_world_rig);
  };
}

ScenePlan DrawScenePlan(const SimulatedSequenceOptions& options, int width_px) {
  const sim::Simulator simulator = OpenSimulator(options);
  return {simulator.Plan(width_px), simulator.about()};
}

std::vector<std::string> CheckScene(const std::string& scene_file) {
  return sim::CheckSceneFile(scene_file, AssetsDir().string(), ReadPosesOfBag);
}

std::vector<std::string> FilesOfScene(const std::string& scene_file) {
  return sim::FilesOfScene(scene_file, ReadPosesOfBag);
}

std::string EssenceOfScene(const std::string& scene_file, const std::string& twin) {
  const sim::Twin which = TwinFromName(twin);
  return AskSimulator([&] { return sim::EssenceOfScene(scene_file, which, ReadPosesOfBag); });
}

std::string HallOfScene(const std::string& scene_file, std::uint64_t seed) {
  return AskSimulator([&] { return sim::ReadSceneInfo(scene_file, seed, ReadPosesOfBag).hall; });
}

std::int64_t CountSceneFrames(const std::string& scene_file) {
  return AskSimulator([&] { return sim::ReadSceneInfo(scene_file, 1, ReadPosesOfBag).frames; });
}

}  // namespace aisle
