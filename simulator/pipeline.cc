#include "simulator/pipeline.h"

#include <algorithm>
#include <mutex>
#include <opencv2/imgproc.hpp>

#include "simulator/camera/pixel_rays.h"
#include "simulator/common/lap_watch.h"
#include "simulator/common/parallel.h"
#include "simulator/trace/hit_image.h"
#include "simulator/truth/correspondence.h"
#include "simulator/truth/image_motion.h"
#include "simulator/truth/moving_shadow.h"
#include "simulator/truth/truth.h"

namespace aisle::sim {
namespace {

/// Automatic exposure meters on pixels of 8 × 8, which cost a sixty-fourth.
constexpr int kMeterFactor = 8;
/// Rows around a band of a rolling shutter, so that filters at its border see their neighbours.
constexpr int kBandMargin = 8;

/// The scene's time and the actors' own.
struct WorldTime {
  std::int64_t stamp_ns = 0;
  std::span<const ActorClock> clocks;
};

/// FrameTruth::depth of a camera's hits.
cv::Mat1f DepthOf(const HitImage& hits) {
  cv::Mat1f depth(hits.height, hits.width);
  for (int y = 0; y < hits.height; ++y) {
    std::copy_n(&hits.t[hits.Index(0, y)], hits.width, depth[y]);
  }
  return depth;
}

FrameTruth Assemble(const Eigen::Isometry3d& T_world_rig, const CameraTruth& left,
                    const CameraTruth& right, std::vector<ObjectTruth> objects) {
  FrameTruth truth;
  truth.T_world_rig = T_world_rig;
  truth.depth = left.depth;
  truth.instance = left.instance;
  truth.object_class = left.object_class;
  truth.depth_right = right.depth;
  truth.instance_right = right.instance;
  truth.dynamic = left.dynamic;
  truth.dynamic_right = right.dynamic;
  truth.actor = left.actor;
  truth.actor_right = right.actor;
  truth.objects = std::move(objects);
  return truth;
}

}  // namespace

struct Pipeline::Impl {
  Impl(World made_world, const StereoCamera& stereo_camera, const PipelineOptions& given)
      : world(std::move(made_world)),
        camera(stereo_camera),
        options(given),
        arena(given.threads),
        rays(MakePixelRays(camera)) {
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
    arena.Execute([&] {
      tracer = std::make_unique<Tracer>(world, options.tracer);
      shader = std::make_unique<Shader>(world, *tracer, options.shade);
      for (std::size_t band = 0; world.has_colour() && band < 3; ++band) {
        bands.push_back(std::make_unique<Band>(*this, band));
      }
    });
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
  std::vector<cv::Mat1f> RadianceAt(Snapshot snapshot, const Eigen::Isometry3d& T_world_rig,
                                    const cv::Range& rows, const Shader& with) const {
    const Instant instant = tracer->Pose(std::move(snapshot));
    const bool whole = rows.size() == rays.height;
    const PixelRays band = whole ? PixelRays{} : RowsOf(rays, rows.start, rows.end);
    const PixelRays& used = whole ? rays : band;
    const std::array views = {
        CameraView(used, CameraPose(camera, T_world_rig, StereoSide::kLeft)),
        CameraView(used, CameraPose(camera, T_world_rig, StereoSide::kRight))};
    std::vector<HitImage> hits = TakeImages();
    TraceViews(instant, views, {.shuffle = options.tile_shuffle}, &hits);
    std::vector<cv::Mat1f> radiance = with.Shade(instant, views, hits);
    GiveBack(std::move(hits));
    return radiance;
  }

  /// What reaches the sensor while the shutter is open, given what does at the stamp. The movers
  /// are where they are at each instant, limbs and wheels skinned anew, and so are their shadows;
  /// the rig is where `rig_at` has it. Averaged in linear light.
  std::vector<cv::Mat1f> WhileOpen(const Instant& instant, const CameraView& left,
                                   const HitImage& hits, const ExposureSetting& setting,
                                   const RigAround& rig_at, const Shader& with,
                                   std::vector<cv::Mat1f> at_stamp) const {
    const ShutterOptions& shutter = options.shutter;
    if (!shutter.IsOpenFor(setting.time_ms)) return at_stamp;
    const double open_s = OpenTime(shutter, setting.time_ms);
    const double motion_px =
        std::max(ImageMotion(world, instant, camera, left, hits, rig_at, open_s),
                 LightMotion(world, instant.snapshot(), camera, open_s));
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
                   : RadianceAt(world.Near(instant.snapshot(), std::llround(1e9 * offset_s)),
                                rig_at(offset_s), rows, with);
      for (std::size_t side = 0; side < 2; ++side) {
        AddInstant(plan, k, light[side], rows.start, &sum[side]);
      }
    }
    return sum;
  }

  /// The rig moves as on its route, from wherever it was put.
  RigAround AsPlanned(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig) const {
    const Eigen::Isometry3d T_rig_planned = T_world_rig * world.PlannedRigPose(stamp_ns).inverse();
    return [this, stamp_ns, T_rig_planned](double offset_s) -> Eigen::Isometry3d {
      return T_rig_planned * world.PlannedRigPose(stamp_ns + std::llround(1e9 * offset_s));
    };
  }

  RenderedFrame Render(int frame_index, std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                       StageTimes* stages) const {
    return Take(frame_index, {stamp_ns, {}}, T_world_rig, AsPlanned(stamp_ns, T_world_rig), stages);
  }

  std::array<cv::Mat3b, 2> TakeColour(int frame_index, std::int64_t stamp_ns,
                                      const Eigen::Isometry3d& T_world_rig) const {
    if (bands.empty()) throw std::logic_error("the world has no colour");
    const Instant instant = tracer->Pose(world.At(stamp_ns));
    const std::array<CameraView, 2> views = Views(T_world_rig);
    std::vector<HitImage> hits = TakeImages();
    TraceViews(instant, views, {.shuffle = options.tile_shuffle}, &hits);
    const ExposureSetting setting = ExposureFor(instant, T_world_rig);
    const RigAround rig_at = AsPlanned(stamp_ns, T_world_rig);
    std::array<std::array<cv::Mat, 3>, 2> planes;
    for (std::size_t band = 0; band < bands.size(); ++band) {
      const Shader& with = *bands[band]->shader;
      const std::vector<cv::Mat1f> light = WhileOpen(instant, views[0], hits[0], setting, rig_at,
                                                     with, with.Shade(instant, views, hits));
      for (std::size_t side = 0; side < 2; ++side) {
        const auto camera_number = static_cast<std::uint32_t>(2 + 2 * band + side);
        const SensorOptions sensor = SensorFor(setting);
        planes[side][2 - band] =
            Expose(SpreadByLens(light[side], sensor.lens), bands[band]->response[side], sensor,
                   {options.seed, static_cast<std::uint32_t>(frame_index), camera_number});
      }
    }
    GiveBack(std::move(hits));
    std::array<cv::Mat3b, 2> pictures;
    for (std::size_t side = 0; side < 2; ++side) cv::merge(planes[side], pictures[side]);
    return pictures;
  }

  RenderedFrame Take(int frame_index, const WorldTime& time, const Eigen::Isometry3d& T_world_rig,
                     const RigAround& rig_at, StageTimes* stages) const {
    LapWatch watch;
    const auto lap = [&](const char* stage) {
      if (stages) (*stages)[stage] += watch.Lap();
    };
    const Instant instant = tracer->Pose(world.At(time.stamp_ns, time.clocks));
    lap("pose");
    const std::array<CameraView, 2> views = Views(T_world_rig);
    std::vector<HitImage> hits = TakeImages();
    TraceViews(instant, views, {.shuffle = options.tile_shuffle}, &hits);
    lap("trace");
    const MovingNow moving(world, instant.snapshot(), options.moving);
    const CameraTruth left = LabelHits(world, instant, hits[0], moving);
    const CameraTruth right = LabelHits(world, instant, hits[1], moving);
    std::vector<ObjectTruth> objects = DescribeMovers(instant, views[0], left);
    lap("truth");
    std::vector<cv::Mat1f> radiance = shader->Shade(instant, views, hits, lap);
    lap("combine");
    const ExposureSetting setting = ExposureFor(instant, T_world_rig);
    lap("meter");
    radiance = WhileOpen(instant, views[0], hits[0], setting, rig_at, *shader, std::move(radiance));
    lap("shutter");
    std::array<cv::Mat1b, 2> pictures;
    ParallelFor(0u, 2u, [&](std::uint32_t side) {
      pictures[side] = Photograph(radiance[side], setting, frame_index, side);
    });
    RenderedFrame frame{.stamp_ns = instant.snapshot().stamp_ns,
                        .left = pictures[0],
                        .right = pictures[1],
                        .exposure_ms = setting.time_ms,
                        .smear_ms = options.shutter.motion_blur ? setting.time_ms : 0,
                        .gain = setting.gain,
                        .truth = Assemble(T_world_rig, left, right, std::move(objects))};
    lap("sensor");
    GiveBack(std::move(hits));
    return frame;
  }

  /// `setting` is the exposure of its sensor.
  Studio MakeStudio(const ExposureSetting& setting) const {
    return {
        .world = world,
        .tracer = *tracer,
        .shader = *shader,
        .camera = camera,
        .rays = rays,
        .moving = options.moving,
        .exposure = SensorFor(setting).exposure,
        .expose = [this, setting](const cv::Mat1f& light) { return WithoutNoise(light, setting); }};
  }

  /// The world as one band of light sees it, its light, and the pixels behind that band's filter.
  struct Band {
    Band(const Impl& of, std::size_t index)
        : world(of.world.InBand(index)),
          shader(std::make_unique<Shader>(world, *of.tracer, of.options.shade)) {
      const cv::Mat1f vignetting = of.FallOff(of.rays);
      for (const std::uint32_t side : {0u, 1u}) {
        const auto camera_number = static_cast<std::uint32_t>(2 + 2 * index + side);
        response[side] =
            MakeResponse(vignetting, of.options.sensor, of.options.seed, camera_number);
      }
    }
    World world;
    std::unique_ptr<Shader> shader;
    std::array<PixelResponse, 2> response;
  };

  World world;
  StereoCamera camera;
  PipelineOptions options;
  Arena arena;
  PixelRays rays;
  std::array<PixelResponse, 2> response;
  PixelRays meter_rays;      ///< for automatic exposure only
  cv::Mat1f meter_fall_off;  ///< of the lens, on the coarse picture
  std::unique_ptr<Tracer> tracer;
  std::unique_ptr<Shader> shader;
  std::vector<std::unique_ptr<Band>> bands;  ///< red, green, blue where the world has colour
  mutable std::mutex mutex;                  ///< guards idle
  mutable std::vector<std::vector<HitImage>> idle;
};

Pipeline::Pipeline(World world, const StereoCamera& camera, const PipelineOptions& options)
    : impl_(std::make_unique<Impl>(std::move(world), camera, options)) {}
Pipeline::~Pipeline() = default;

const World& Pipeline::world() const { return impl_->world; }

RenderedFrame Pipeline::Render(int frame_index, std::int64_t stamp_ns,
                               const Eigen::Isometry3d& T_world_rig) const {
  return impl_->arena.Execute(
      [&] { return impl_->Render(frame_index, stamp_ns, T_world_rig, nullptr); });
}

RenderedFrame Pipeline::RenderTimed(int frame_index, const Moment& moment,
                                    StageTimes* stages) const {
  return impl_->arena.Execute(
      [&] { return impl_->Render(frame_index, moment.stamp_ns, moment.T_world_rig, stages); });
}

RenderedFrame Pipeline::Render(int frame_index, std::int64_t stamp_ns, const Shot& shot) const {
  return impl_->arena.Execute([&] {
    return impl_->Take(
        frame_index, {stamp_ns, shot.clocks}, shot.T_world_rig,
        [&](double offset_s) { return shot.At(offset_s); }, nullptr);
  });
}

std::array<cv::Mat3b, 2> Pipeline::RenderColour(int frame_index, std::int64_t stamp_ns,
                                                const Eigen::Isometry3d& T_world_rig) const {
  return impl_->arena.Execute(
      [&] { return impl_->TakeColour(frame_index, stamp_ns, T_world_rig); });
}

cv::Mat1f Pipeline::RenderDepth(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig) const {
  return impl_->arena.Execute([&] {
    const Instant instant = impl_->tracer->Pose(impl_->world.At(stamp_ns));
    const std::array<CameraView, 2> views = impl_->Views(T_world_rig);
    std::vector<HitImage> hits;
    TraceViews(instant, std::span(views).first(1), {}, &hits);
    return DepthOf(hits[0]);
  });
}

std::array<cv::Mat1f, 2> Pipeline::RenderRadiance(std::int64_t stamp_ns,
                                                  const Eigen::Isometry3d& T_world_rig) const {
  return impl_->arena.Execute([&] {
    const Instant instant = impl_->tracer->Pose(impl_->world.At(stamp_ns));
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
  return impl_->arena.Execute([&] {
    const Impl& self = *impl_;
    const Instant instant = self.tracer->Pose(self.world.At(stamp_ns));
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

Studio Pipeline::StudioAt(const Moment& moment) const {
  return impl_->arena.Execute([&] {
    const Instant instant = impl_->tracer->Pose(impl_->world.At(moment.stamp_ns));
    return impl_->MakeStudio(impl_->ExposureFor(instant, moment.T_world_rig));
  });
}

void Pipeline::Execute(const std::function<void()>& work) const { impl_->arena.Execute(work); }

}  // namespace aisle::sim
