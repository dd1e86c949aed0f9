#include "simulator/pipeline.h"

#include <tbb/task_arena.h>
#include <xxhash.h>

#include <chrono>
#include <mutex>
#include <opencv2/imgproc.hpp>

#include "simulator/camera/pixel_rays.h"
#include "simulator/raster/raster.h"
#include "simulator/shade/reference/light_error.h"
#include "simulator/shade/reference/reference.h"
#include "simulator/trace/hit_image.h"
#include "simulator/truth/correspondence.h"
#include "simulator/truth/image_motion.h"
#include "simulator/truth/moving_shadow.h"
#include "simulator/truth/truth.h"

namespace aisle::sim {
namespace {

using Clock = std::chrono::steady_clock;

/// Automatic exposure meters on pixels of 8 × 8, which cost a sixty-fourth.
constexpr int kMeterFactor = 8;
/// Rows around a band of a rolling shutter, so that filters at its border see their neighbours.
constexpr int kBandMargin = 8;

/// Wall time since it was made or last read, in milliseconds.
class Stopwatch {
 public:
  double Lap() {
    const Clock::time_point now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
  }

 private:
  Clock::time_point start_ = Clock::now();
};

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// One hash of all that was added, in its order.
struct StageHasher {
  std::uint64_t value = 0;

  template <typename Values>
  StageHasher& Add(const Values& values) {
    value = XXH3_64bits_withSeed(values.data(), values.size() * sizeof(*values.data()), value);
    return *this;
  }
  StageHasher& Add(const cv::Mat1f& image) { return AddRows(image); }
  StageHasher& Add(const cv::Mat1b& image) { return AddRows(image); }

 private:
  StageHasher& AddRows(const cv::Mat& image) {
    for (int y = 0; y < image.rows; ++y) {
      value = XXH3_64bits_withSeed(image.ptr(y),
                                   static_cast<std::size_t>(image.cols) * image.elemSize(), value);
    }
    return *this;
  }
};

FrameTruth Assemble(const Eigen::Isometry3d& T_world_rig, const CameraTruth& left,
                    const CameraTruth& right, const std::vector<MoverTruth>& movers) {
  FrameTruth truth;
  truth.T_world_rig = T_world_rig;
  truth.depth = left.depth;
  truth.instance = left.instance;
  truth.object_class = left.object_class;
  truth.depth_right = right.depth;
  truth.instance_right = right.instance;
  truth.object_class_right = right.object_class;
  truth.dynamic = left.dynamic;
  truth.dynamic_right = right.dynamic;
  truth.actor = left.actor;
  truth.actor_right = right.actor;
  for (const MoverTruth& mover : movers) {
    truth.objects.push_back({.instance = mover.instance,
                             .box_visible = mover.box_visible,
                             .box_full = mover.box_full,
                             .T_world_object = mover.T_world_object,
                             .extent_m = mover.extent_m,
                             .center_m = mover.center_m,
                             .velocity_mps = mover.velocity_mps,
                             .visible_fraction = mover.visible_fraction,
                             .visible_pixels = mover.visible_pixels,
                             .dynamic_pixels = mover.dynamic_pixels});
  }
  return truth;
}

}  // namespace

struct Pipeline::Impl {
  Impl(World made_world, const StereoCamera& stereo_camera, const PipelineOptions& given)
      : world(std::move(made_world)),
        camera(stereo_camera),
        options(given),
        arena(given.threads > 0 ? given.threads : tbb::task_arena::automatic),
        rays(MakePixelRays(camera)),
        tracer(world, options.tracer) {
    for (const std::string& error : {options.sensor.Validate(), options.shutter.Validate(),
                                     options.auto_exposure.Validate()}) {
      if (!error.empty()) throw std::invalid_argument("sensor: " + error);
    }
    const cv::Mat1f vignetting = FallOff(rays);
    for (const std::uint32_t side : {0u, 1u}) {
      response[side] = MakeResponse(vignetting, options.sensor, options.seed, side);
    }
    if (options.auto_exposure.on) {
      meter_rays = MakePixelRays(Coarser(camera, kMeterFactor));
      meter_fall_off = FallOff(meter_rays);
    }
    arena.execute([&] { shader = std::make_unique<Shader>(world, tracer, options.shade); });
  }

  std::array<CameraView, 2> Views(const Eigen::Isometry3d& T_world_rig) const {
    return {CameraView(rays, CameraPose(camera, T_world_rig, StereoSide::kLeft)),
            CameraView(rays, CameraPose(camera, T_world_rig, StereoSide::kRight))};
  }

  cv::Mat1f FallOff(const PixelRays& of) const {
    return VignettingMap(of.width, of.height, of.x, of.y, options.sensor.vignetting);
  }

  std::vector<HitImage> TakeImages() const {
    const std::lock_guard lock(mutex);
    if (idle.empty()) return {};
    std::vector<HitImage> images = std::move(idle.back());
    idle.pop_back();
    return images;
  }
  void GiveBack(std::vector<HitImage> images) const {
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(images));
  }

  /// Time and gain of the exposure: as given, or metered on a coarse picture of the left camera's
  /// view at this very instant.
  ExposureSetting ExposureFor(const Instant& instant, const Eigen::Isometry3d& T_world_rig) const {
    if (!options.auto_exposure.on) return {options.exposure_ms, options.sensor.gain};
    const std::array view = {
        CameraView(meter_rays, CameraPose(camera, T_world_rig, StereoSide::kLeft))};
    std::vector<HitImage> hits;
    TraceViews(instant, view, {}, &hits);
    const cv::Mat1f light(shader->Shade(instant, view, hits).front().mul(meter_fall_off));
    return ChooseExposure(light, WhitePerMs(), options.sensor.tone, options.auto_exposure);
  }

  /// 255 where the left image, `reduce` times smaller, shows a mover or the next pixel does.
  cv::Mat1b MoversIn(const Moment& moment, int reduce) const {
    const StereoCamera small = Coarser(camera, reduce);
    const PixelRays small_rays = MakePixelRays(small);
    const std::array view = {
        CameraView(small_rays, CameraPose(small, moment.T_world_rig, StereoSide::kLeft))};
    std::vector<HitImage> hits;
    TraceViews(tracer.Pose(world.At(moment.stamp_ns)), view, {}, &hits);
    cv::Mat1b movers(small.height, small.width, std::uint8_t{0});
    for (int y = 0; y < small.height; ++y) {
      for (int x = 0; x < small.width; ++x) {
        const std::uint32_t geometry = hits[0].geometry[hits[0].Index(x, y)];
        if (geometry != 0 && geometry != kNoGeometry) movers(y, x) = 255;
      }
    }
    cv::dilate(movers, movers, cv::Mat1b::ones(3, 3));
    return movers;
  }

  double WhitePerMs() const {
    return options.sensor.exposure / (options.sensor.gain * options.exposure_ms);
  }

  /// The sensor as the exposure sets it.
  SensorOptions SensorFor(const ExposureSetting& setting) const {
    SensorOptions sensor = options.sensor;
    if (options.auto_exposure.on) {
      sensor.exposure = static_cast<float>(WhitePerMs() * setting.time_ms * setting.gain);
      sensor.gain = setting.gain;
    }
    return sensor;
  }

  cv::Mat1b Photograph(const cv::Mat1f& radiance, const ExposureSetting& setting, int frame_index,
                       std::uint32_t side) const {
    const SensorOptions sensor = SensorFor(setting);
    return Expose(SpreadByLens(radiance, sensor.lens), response[side], sensor,
                  {options.seed, static_cast<std::uint32_t>(frame_index), side});
  }

  /// The left picture of a sensor without noise and without a pattern of its own.
  cv::Mat1b WithoutNoise(const cv::Mat1f& radiance, const ExposureSetting& setting) const {
    SensorOptions sensor = SensorFor(setting);
    sensor.noise = sensor.fixed_pattern = false;
    return Expose(SpreadByLens(radiance, sensor.lens),
                  MakeResponse(FallOff(rays), sensor, options.seed, 0), sensor,
                  {options.seed, 0, 0});
  }

  /// Radiance of the given rows of both cameras at an instant that nobody asks the truth of.
  std::vector<cv::Mat1f> RadianceAt(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                                    const cv::Range& rows) const {
    const Instant instant = tracer.Pose(world.At(stamp_ns));
    const bool whole = rows.size() == rays.height;
    const PixelRays band = whole ? PixelRays{} : RowsOf(rays, rows.start, rows.end);
    const PixelRays& used = whole ? rays : band;
    const std::array views = {
        CameraView(used, CameraPose(camera, T_world_rig, StereoSide::kLeft)),
        CameraView(used, CameraPose(camera, T_world_rig, StereoSide::kRight))};
    std::vector<HitImage> hits = TakeImages();
    TraceViews(instant, views, {.shuffle = options.tile_shuffle}, &hits);
    std::vector<cv::Mat1f> radiance = shader->Shade(instant, views, hits);
    GiveBack(std::move(hits));
    return radiance;
  }

  /// What reaches the sensor while the shutter is open, given what does at the stamp. The movers
  /// are where they are at each instant, limbs and wheels skinned anew, and so are their shadows;
  /// the rig moves as on its route, from wherever it was put. Averaged in linear light.
  std::vector<cv::Mat1f> WhileOpen(const Instant& instant, const CameraView& left,
                                   const HitImage& hits, const ExposureSetting& setting,
                                   const Eigen::Isometry3d& T_world_rig,
                                   std::vector<cv::Mat1f> at_stamp) const {
    const ShutterOptions& shutter = options.shutter;
    if (!shutter.IsOpenFor(setting.time_ms)) return at_stamp;
    const std::int64_t stamp_ns = instant.snapshot().stamp_ns;
    const Eigen::Isometry3d T_rig_planned = T_world_rig * world.PlannedRigPose(stamp_ns).inverse();
    const auto rig_at = [&](double offset_s) {
      return T_rig_planned * world.PlannedRigPose(stamp_ns + std::llround(1e9 * offset_s));
    };
    const double open_s = OpenTime(shutter, setting.time_ms);
    const double motion_px = ImageMotion(world, instant, camera, left, hits, rig_at(-open_s / 2),
                                         rig_at(open_s / 2), open_s);
    const ShutterPlan plan = PlanShutter(shutter, setting.time_ms, camera.height, motion_px);
    const int instants = static_cast<int>(plan.offsets_s.size());
    if (instants == 1) return at_stamp;
    std::vector<cv::Mat1f> sum(2);
    for (cv::Mat1f& side : sum) side = cv::Mat1f::zeros(camera.height, camera.width);
    for (int k = 0; k < instants; ++k) {
      const double offset_s = plan.offsets_s[static_cast<std::size_t>(k)];
      const bool is_stamp = k == instants / 2;
      cv::Range rows = is_stamp ? cv::Range(0, camera.height) : plan.RowsOf(k);
      if (rows.empty()) continue;
      rows = {std::max(0, rows.start - kBandMargin),
              std::min(camera.height, rows.end + kBandMargin)};
      const std::vector<cv::Mat1f> light =
          is_stamp ? at_stamp
                   : RadianceAt(stamp_ns + std::llround(1e9 * offset_s), rig_at(offset_s), rows);
      for (std::size_t side = 0; side < 2; ++side) {
        AddInstant(plan, k, light[side], rows.start, &sum[side]);
      }
    }
    return sum;
  }

  RenderedFrame Render(int frame_index, std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                       std::map<std::string, double>* stages) const {
    Stopwatch watch;
    const auto lap = [&](const char* stage) {
      if (stages) (*stages)[stage] += watch.Lap();
    };
    const Instant instant = tracer.Pose(world.At(stamp_ns));
    lap("pose");
    const std::array<CameraView, 2> views = Views(T_world_rig);
    std::vector<HitImage> hits = TakeImages();
    TraceViews(instant, views, {.shuffle = options.tile_shuffle}, &hits);
    lap("trace");
    const MovingNow moving(world, instant.snapshot(), options.moving);
    const CameraTruth left = LabelHits(world, instant, hits[0], moving);
    const CameraTruth right = LabelHits(world, instant, hits[1], moving);
    const std::vector<MoverTruth> movers = DescribeMovers(instant, views[0], left);
    lap("truth");
    std::vector<cv::Mat1f> radiance = shader->Shade(instant, views, hits, lap);
    lap("combine");
    const ExposureSetting setting = ExposureFor(instant, T_world_rig);
    lap("meter");
    radiance = WhileOpen(instant, views[0], hits[0], setting, T_world_rig, std::move(radiance));
    lap("shutter");
    RenderedFrame frame{.stamp_ns = stamp_ns,
                        .left = Photograph(radiance[0], setting, frame_index, 0),
                        .right = Photograph(radiance[1], setting, frame_index, 1),
                        .exposure_ms = setting.time_ms,
                        .smear_ms = options.shutter.motion_blur ? setting.time_ms : 0,
                        .gain = setting.gain,
                        .truth = Assemble(T_world_rig, left, right, movers)};
    lap("sensor");
    GiveBack(std::move(hits));
    return frame;
  }

  World world;
  StereoCamera camera;
  PipelineOptions options;
  mutable tbb::task_arena arena;
  PixelRays rays;
  std::array<PixelResponse, 2> response;
  PixelRays meter_rays;      ///< for automatic exposure only
  cv::Mat1f meter_fall_off;  ///< of the lens, on the coarse picture
  Tracer tracer;
  std::unique_ptr<Shader> shader;
  mutable std::mutex mutex;  ///< guards idle
  mutable std::vector<std::vector<HitImage>> idle;
};

Pipeline::Pipeline(World world, const StereoCamera& camera, const PipelineOptions& options)
    : impl_(std::make_unique<Impl>(std::move(world), camera, options)) {}
Pipeline::~Pipeline() = default;

const World& Pipeline::world() const { return impl_->world; }

RenderedFrame Pipeline::Render(int frame_index, std::int64_t stamp_ns,
                               const Eigen::Isometry3d& T_world_rig) const {
  return impl_->arena.execute(
      [&] { return impl_->Render(frame_index, stamp_ns, T_world_rig, nullptr); });
}

std::array<cv::Mat1f, 2> Pipeline::RenderRadiance(std::int64_t stamp_ns,
                                                  const Eigen::Isometry3d& T_world_rig) const {
  return impl_->arena.execute([&] {
    const Instant instant = impl_->tracer.Pose(impl_->world.At(stamp_ns));
    const std::array<CameraView, 2> views = impl_->Views(T_world_rig);
    std::vector<HitImage> hits;
    TraceViews(instant, views, {}, &hits);
    std::vector<cv::Mat1f> radiance = impl_->shader->Shade(instant, views, hits);
    return std::array{radiance[0], radiance[1]};
  });
}

MotionTruth Pipeline::RenderMotion(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                                   std::int64_t next_stamp_ns,
                                   const Eigen::Isometry3d& T_world_rig_next) const {
  return impl_->arena.execute([&] {
    const Impl& self = *impl_;
    const Instant instant = self.tracer.Pose(self.world.At(stamp_ns));
    const std::array<CameraView, 2> views = self.Views(T_world_rig);
    std::vector<HitImage> hits;
    TraceViews(instant, std::span(views).first(1), {}, &hits);
    const MovingNow moving(self.world, instant.snapshot(), self.options.moving);
    Correspondence found = FindCorrespondence(self.world, instant, self.camera, views[0], hits[0],
                                              self.world.At(next_stamp_ns), T_world_rig_next);
    return MotionTruth{std::move(found.disparity), std::move(found.occluded), std::move(found.flow),
                       std::move(found.scene_flow),
                       FindMovingShadows(self.world, instant, views[0], hits[0], moving)};
  });
}

VerifyReport Pipeline::Verify(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                              std::int64_t next_stamp_ns,
                              const Eigen::Isometry3d& T_world_rig_next) const {
  return impl_->arena.execute([&] {
    const Impl& self = *impl_;
    const Instant now = self.tracer.Pose(self.world.At(stamp_ns));
    const Instant next = self.tracer.Pose(self.world.At(next_stamp_ns));
    const std::array<CameraView, 2> views = self.Views(T_world_rig);
    const std::array<CameraView, 2> views_next = self.Views(T_world_rig_next);
    std::vector<HitImage> hits, hits_next;
    TraceViews(now, views, {}, &hits);
    TraceViews(next, std::span(views_next).first(1), {}, &hits_next);
    const MovingNow moving(self.world, now.snapshot(), self.options.moving);
    const MovingNow moving_then(self.world, next.snapshot(), self.options.moving);
    const std::array<CameraTruth, 2> sides = {LabelHits(self.world, now, hits[0], moving),
                                              LabelHits(self.world, now, hits[1], moving)};
    const cv::Mat1f depth_next = LabelHits(self.world, next, hits_next[0], moving_then).depth;

    std::array<Agreement, 2> agreement;
    for (std::size_t side = 0; side < 2; ++side) {
      const Eigen::Isometry3d& T_world_camera = views[side].T_world_camera;
      const RasterView drawn =
          self.rays.straight
              ? Rasterize(self.world, now.snapshot(), self.camera, T_world_camera)
              : RasterizeThroughLens(self.world, now.snapshot(), self.rays, T_world_camera);
      agreement[side] = Compare(drawn, sides[side].depth, sides[side].instance);
    }
    const Correspondence found = FindCorrespondence(self.world, now, self.camera, views[0], hits[0],
                                                    next.snapshot(), T_world_rig_next);
    const WarpCheck stereo =
        CheckStereo(self.camera, self.rays, sides[0].depth, sides[1].depth, found);
    const WarpCheck flow =
        CheckFlow(self.camera, DepthInNextCamera(views[0], hits[0], found, T_world_rig_next),
                  depth_next, found.flow);
    return VerifyReport{.raster_agreement_left = agreement[0].share(),
                        .raster_agreement_right = agreement[1].share(),
                        .raster_compared = agreement[0].compared + agreement[1].compared,
                        .stereo_median_px = stereo.median_px,
                        .flow_median_px = flow.median_px,
                        .stereo_compared = stereo.compared,
                        .flow_compared = flow.compared};
  });
}

StageHashes Pipeline::HashStages(int frame_index, std::int64_t stamp_ns,
                                 const Eigen::Isometry3d& T_world_rig) const {
  return impl_->arena.execute([&] {
    const Impl& self = *impl_;
    const Instant instant = self.tracer.Pose(self.world.At(stamp_ns));
    const std::array<CameraView, 2> views = self.Views(T_world_rig);
    std::vector<HitImage> hits;
    TraceViews(instant, views, {}, &hits);
    const std::vector<cv::Mat1f> radiance = self.shader->Shade(instant, views, hits);
    const RenderedFrame frame = self.Render(frame_index, stamp_ns, T_world_rig, nullptr);
    StageHasher triangles, points, light, linear, pictures;
    for (std::size_t side = 0; side < 2; ++side) {
      triangles.Add(hits[side].geometry).Add(hits[side].primitive);
      points.Add(hits[side].t).Add(hits[side].u).Add(hits[side].v);
      linear.Add(radiance[side]);
    }
    const auto solved = self.shader->static_light().At(instant.snapshot().light_scale);
    light.Add(solved->total).Add(solved->direct).Add(solved->volume.nodes());
    pictures.Add(frame.left).Add(frame.right);
    return StageHashes{triangles.value, points.value, light.value, linear.value, pictures.value};
  });
}

PictureChanges Pipeline::CompareInTime(const std::array<Moment, 3>& moments) const {
  return impl_->arena.execute([&] {
    const Impl& self = *impl_;
    const ExposureSetting setting = self.ExposureFor(
        self.tracer.Pose(self.world.At(moments[0].stamp_ns)), moments[0].T_world_rig);
    const Studio studio{self.world,
                        self.tracer,
                        *self.shader,
                        self.camera,
                        self.rays,
                        self.options.moving,
                        [&](const cv::Mat1f& light) { return self.WithoutNoise(light, setting); }};
    const PictureWithFlow first = TakeWithFlow(studio, moments[0], moments[1]);
    const PictureWithFlow second = TakeWithFlow(studio, moments[1], moments[2]);
    // Where the points of the third go next is not asked.
    return aisle::sim::CompareInTime(first, second, TakeWithFlow(studio, moments[2], moments[2]));
  });
}

LightCheck Pipeline::CheckLight(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                                int samples, int reduce) const {
  const Impl& self = *impl_;
  const StereoCamera small = Coarser(self.camera, reduce);
  LightCheck check;
  const cv::Rect whole(0, 0, small.width * reduce, small.height * reduce);
  cv::resize(RenderRadiance(stamp_ns, T_world_rig)[0](whole), check.nightly,
             {small.width, small.height}, 0, 0, cv::INTER_AREA);
  check.nightly *= self.options.sensor.exposure;
  std::array<cv::Mat1f, 2> halves;
  self.arena.execute([&] {
    const Instant instant = self.tracer.Pose(self.world.At(stamp_ns));
    const TexturePool textures(self.world.textures());
    const Reference reference(self.world, textures);
    const PixelRays rays = MakePixelRays(small);
    const CameraView view(rays, CameraPose(small, T_world_rig, StereoSide::kLeft));
    for (std::size_t i = 0; i < 2; ++i) {
      halves[i] = reference.Render(instant, view, {.samples = (samples + 1) / 2, .seed = i + 1});
      halves[i] *= self.options.sensor.exposure;
    }
  });
  check.reference = (halves[0] + halves[1]) / 2;
  check.halves = halves;
  const LightError noise = CompareLight(halves[0], halves[1]);
  check.noise_median_relative = noise.median_relative;
  check.noise_ssim = noise.ssim;
  const LightError error = CompareLight(check.nightly, check.reference);
  check.median_relative_error = error.median_relative;
  check.ssim = error.ssim;
  check.mean_ratio = error.mean_ratio;
  return check;
}

LightChangeCheck Pipeline::CheckLightChange(const std::array<Moment, 2>& moments, int samples,
                                            int reduce) const {
  LightChangeCheck check;
  check.now = CheckLight(moments[0].stamp_ns, moments[0].T_world_rig, samples, reduce);
  const LightCheck then = CheckLight(moments[1].stamp_ns, moments[1].T_world_rig, samples, reduce);
  cv::Mat1f ours;
  cv::subtract(then.nightly, check.now.nightly, ours);
  std::array<cv::Mat1f, 2> halves;
  for (std::size_t i = 0; i < 2; ++i) {
    cv::subtract(then.halves[i], check.now.halves[i], halves[i]);
  }
  const auto compare = [&](const cv::Mat1b& where) -> LightChangeCheck::Part {
    const LightChange change = CompareChange(ours, halves, where);
    return {change.pixels,      change.rms_ours,  change.rms_reference,
            change.rms_between, change.rms_noise, change.correlation};
  };
  cv::Mat1b movers(ours.size(), std::uint8_t{0});
  for (const Moment& moment : moments) movers |= impl_->MoversIn(moment, reduce);
  check.everywhere = compare(cv::Mat1b(ours.size(), std::uint8_t{1}));
  check.on_movers = compare(movers);
  return check;
}

RenderBench Pipeline::Bench(std::span<const std::int64_t> stamps_ns,
                            std::span<const Eigen::Isometry3d> poses) const {
  return impl_->arena.execute([&] {
    std::vector<double> pair, bare;
    std::map<std::string, std::vector<double>> stages;
    for (std::size_t i = 0; i < stamps_ns.size(); ++i) {
      const Instant instant = impl_->tracer.Pose(impl_->world.At(stamps_ns[i]));
      const std::array<CameraView, 2> views = impl_->Views(poses[i]);
      std::vector<HitImage> hits = impl_->TakeImages();
      Stopwatch watch;
      TraceViews(instant, views, {}, &hits);
      const double bare_ms = watch.Lap();
      impl_->GiveBack(std::move(hits));
      std::map<std::string, double> frame_stages;
      watch.Lap();
      impl_->Render(static_cast<int>(i), stamps_ns[i], poses[i], &frame_stages);
      const double pair_ms = watch.Lap();
      if (i == 0 && stamps_ns.size() > 1) continue;  // buffers are touched for the first time
      bare.push_back(bare_ms);
      pair.push_back(pair_ms);
      for (const auto& [stage, ms] : frame_stages) stages[stage].push_back(ms);
    }
    RenderBench result{.pair_ms = Median(pair),
                       .bare_primary_ms = Median(bare),
                       .ratio = Median(pair) / Median(bare),
                       .frames = static_cast<int>(pair.size()),
                       .stage_ms = {}};
    for (auto& [stage, ms] : stages) result.stage_ms[stage] = Median(ms);
    return result;
  });
}

}  // namespace aisle::sim
