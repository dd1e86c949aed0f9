#include "simulator/simulator.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>

#include "simulator/common/mix.h"
#include "simulator/content_hash.h"
#include "simulator/pipeline.h"
#include "simulator/scene/essence.h"
#include "simulator/scene/load.h"
#include "simulator/scene/vary.h"
#include "simulator/scene_camera.h"
#include "simulator/shade/light/light_cache.h"
#include "simulator/site.h"
#include "simulator/world/build.h"
#include "simulator/world/plan.h"
#include "simulator/world/recorded_ways.h"

namespace aisle::sim {
namespace {

Scene TwinOf(const Scene& written, Twin twin) {
  if (twin == Twin::kNone) return WithDynamics(written, Dynamics::kNone);
  if (twin == Twin::kLow) return WithDynamics(written, Dynamics::kLow);
  if (twin == Twin::kMid) return WithDynamics(written, Dynamics::kMid);
  if (twin == Twin::kHigh) return WithDynamics(written, Dynamics::kHigh);
  Scene scene = WithDynamics(written, written.dynamics);
  if (twin == Twin::kEmpty) return WithoutActors(std::move(scene));
  if (twin == Twin::kFrozen) return Frozen(std::move(scene));
  return scene;
}

void SetSensor(const SensorSpec& spec, PipelineOptions* options) {
  const double gain = std::pow(10.0, spec.gain_db / 20);
  SensorOptions& sensor = options->sensor;
  sensor.gain = static_cast<float>(gain);
  sensor.exposure =
      static_cast<float>(spec.exposure_ms * gain * (spec.sensitivity_e_per_ms / spec.full_well_e));
  sensor.full_well_e = static_cast<float>(spec.full_well_e);
  sensor.read_noise_e = static_cast<float>(spec.read_noise_e);
  sensor.prnu = static_cast<float>(spec.prnu);
  sensor.dsnu_e = static_cast<float>(spec.dsnu_e);
  sensor.black_level = static_cast<float>(spec.black_level);
  sensor.tone = spec.tone == ToneSpec::kCompanded ? Tone::kCompanded : Tone::kLinear;
  sensor.noise = spec.noise;
  sensor.fixed_pattern = spec.fixed_pattern;
  sensor.vignetting = static_cast<float>(spec.vignetting);
  sensor.lens = {.blur_px = static_cast<float>(spec.blur_px),
                 .field_blur_px = static_cast<float>(spec.field_blur_px),
                 .glare = static_cast<float>(spec.glare)};
  options->exposure_ms = spec.exposure_ms;
  options->shutter.motion_blur = spec.motion_blur;
  options->shutter.readout_ms = spec.readout_ms;
  options->auto_exposure.on = spec.auto_exposure;
  options->auto_exposure.target_grey = static_cast<float>(spec.auto_target_grey);
  options->auto_exposure.meter_from = static_cast<float>(spec.auto_meter_from);
  options->auto_exposure.longest_ms = spec.auto_longest_ms;
  options->auto_exposure.step_ev = spec.auto_step_ev;
}

/// Each pair has sensors of its own, and so noise of its own; the unnamed one's seed is the run's.
std::uint64_t SensorSeed(std::uint64_t seed, const std::string& pair) {
  return pair.empty() ? seed : Mix(seed ^ XXH3_64bits(pair.data(), pair.size()));
}

std::vector<InstanceInfo> DescribeInstances(const World& world) {
  std::vector<InstanceInfo> instances;
  for (const Instance& instance : world.instances()) {
    instances.push_back({.name = instance.name,
                         .object_class = std::string(ClassName(instance.object_class)),
                         .class_id = static_cast<std::uint8_t>(instance.object_class),
                         .is_actor = instance.is_actor});
  }
  return instances;
}

/// Nobody's models are opened where nobody moves as recorded.
FloorWays WaysOf(const Scene& scene, const std::string& assets_dir) {
  const auto is_recorded = [](const PersonSpec& one) { return !one.capture.bvh.name.empty(); };
  if (!std::ranges::any_of(scene.people, is_recorded)) return {};
  AssetLibrary assets(assets_dir);
  return RecordedWays(scene, &assets);
}

}  // namespace

struct Simulator::Impl {
  Scene scene;
  RigInfo rig;
  std::vector<InstanceInfo> instances;
  std::uint64_t hash = 0;
  std::optional<Site> site;
  std::unique_ptr<Pipeline> pipeline;
};

Simulator::Simulator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

Simulator Simulator::Load(const std::string& scene_file, const std::string& assets_dir,
                          const SimulatorOptions& options) {
  auto impl = std::make_unique<Impl>();
  impl->scene = TwinOf(LoadScene(scene_file, options.bags), options.twin);
  if (auto errors = LensErrors(impl->scene); !errors.empty()) throw SceneError(std::move(errors));
  const std::string pair = options.pair.empty() ? impl->scene.rig.pair : options.pair;
  impl->scene = WithPair(std::move(impl->scene), pair);
  impl->scene.camera.colour = impl->scene.camera.colour && options.colour;
  const Scene& scene = impl->scene;
  if (scene.rig.pair != pair) {
    throw SceneError({fmt::format("{}: the rig has no pair '{}'", scene_file, pair)});
  }
  const FloorWays ways = WaysOf(scene, assets_dir);
  if (auto troubles = CheckSeed(scene, options.seed, ways); !troubles.empty()) {
    throw SceneError(std::move(troubles));
  }
  impl->rig = RigOf(scene.camera);
  World world = BuildWorld(scene, assets_dir, options.seed);
  impl->instances = DescribeInstances(world);
  impl->site.emplace(Seeded(scene, options.seed), world);
  impl->hash = ContentHash(EssenceOf(scene_file, options.twin != Twin::kEmpty, options.bags), world,
                           static_cast<std::int64_t>(1e9 * scene.duration_s()), options);
  PipelineOptions pipeline;
  pipeline.seed = SensorSeed(options.seed, pair);
  pipeline.threads = options.threads;
  // What the exposure is set to, also where an automatic one is longer or shorter: what moves must
  // not depend on the light.
  pipeline.moving = {.threshold_mps = static_cast<float>(scene.dynamic_threshold_mps),
                     .window_ms = scene.sensor.exposure_ms};
  pipeline.tracer.isa = pipeline.shade.statics.isa = options.isa;
  StaticLightOptions& light = pipeline.shade.statics;
  for (float* spacing : {&light.texel_m, &light.coarse_texel_m, &light.volume_spacing_m}) {
    *spacing *= static_cast<float>(options.light_spacing);
  }
  if (options.keep_light) light.cache_folder = DefaultLightCache();
  pipeline.shade.statics.progress = options.light_progress;
  SetSensor(scene.sensor, &pipeline);
  impl->pipeline = std::make_unique<Pipeline>(std::move(world), CameraOf(scene.camera), pipeline);
  return Simulator(std::move(impl));
}

const RigInfo& Simulator::rig() const { return impl_->rig; }
int Simulator::frame_count() const { return impl_->scene.frames; }
double Simulator::rate_hz() const { return impl_->scene.rate_hz; }
double Simulator::dynamic_threshold_mps() const { return impl_->scene.dynamic_threshold_mps; }
const std::vector<InstanceInfo>& Simulator::instances() const { return impl_->instances; }
const std::string& Simulator::about() const { return impl_->scene.about; }
std::uint64_t Simulator::content_hash() const { return impl_->hash; }
const Site& Simulator::site() const { return *impl_->site; }
const Pipeline& Simulator::pipeline() const { return *impl_->pipeline; }

std::int64_t Simulator::Stamp(int frame_index) const {
  return std::llround(1e9 * frame_index / impl_->scene.rate_hz);
}

Eigen::Isometry3d Simulator::PlannedPose(std::int64_t stamp_ns) const {
  return impl_->pipeline->world().PlannedRigPose(stamp_ns);
}

cv::Mat3b Simulator::Plan(int width_px) const {
  if (width_px <= 0) {
    throw std::invalid_argument(
        fmt::format("a plan {} pixels wide: expected more than 0", width_px));
  }
  return DrawPlan(impl_->pipeline->world(), Stamp(frame_count()), width_px).picture;
}

RenderedFrame Simulator::Render(int frame_index, std::int64_t stamp_ns,
                                const Eigen::Isometry3d& T_world_rig) const {
  return impl_->pipeline->Render(frame_index, stamp_ns, T_world_rig);
}

RenderedFrame Simulator::Render(int frame_index, std::int64_t stamp_ns, const Shot& shot) const {
  return impl_->pipeline->Render(frame_index, stamp_ns, shot);
}

const std::string& Simulator::pair() const { return impl_->scene.rig.pair; }
bool Simulator::has_colour() const { return impl_->pipeline->world().has_colour(); }

std::array<cv::Mat3b, 2> Simulator::RenderColour(int frame_index, std::int64_t stamp_ns,
                                                 const Eigen::Isometry3d& T_world_rig) const {
  return impl_->pipeline->RenderColour(frame_index, stamp_ns, T_world_rig);
}

cv::Mat1f Simulator::RenderDepth(std::int64_t stamp_ns,
                                 const Eigen::Isometry3d& T_world_rig) const {
  return impl_->pipeline->RenderDepth(stamp_ns, T_world_rig);
}

MotionTruth Simulator::RenderMotion(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                                    std::int64_t next_stamp_ns,
                                    const Eigen::Isometry3d& T_world_rig_next) const {
  return impl_->pipeline->RenderMotion(stamp_ns, T_world_rig, next_stamp_ns, T_world_rig_next);
}

}  // namespace aisle::sim
