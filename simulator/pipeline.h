#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "simulator/camera/stereo_camera.h"
#include "simulator/frames.h"
#include "simulator/sensor/auto_exposure.h"
#include "simulator/sensor/sensor.h"
#include "simulator/sensor/shutter.h"
#include "simulator/shade/shader.h"
#include "simulator/studio.h"
#include "simulator/truth/moving_now.h"
#include "simulator/world/world.h"

namespace aisle::sim {

struct PipelineOptions {
  std::uint64_t seed = 1;          ///< of the sensor noise
  MovingOptions moving;            ///< which surfaces are dynamic
  int threads = 0;                 ///< 0: as many as the machine has
  std::uint64_t tile_shuffle = 0;  ///< order of the tiles; changes no result
  TracerOptions tracer;
  ShadeOptions shade;
  SensorOptions sensor;
  double exposure_ms = 8;  ///< the time for which sensor.exposure holds
  ShutterOptions shutter;
  AutoExposureOptions auto_exposure;
};

/// Wall time by stage of a frame, milliseconds.
using StageTimes = std::map<std::string, double>;

/// A world and a stereo camera, ready to take pictures: At(t) -> trace -> { truth; shade ->
/// sensor }. What Simulator is made of, for those who make their world by other means than a scene
/// file. Arguments are as Simulator has them.
class Pipeline {
 public:
  /// Solves the static light: seconds for a hall. Throws std::invalid_argument naming the option
  /// that breaks its rule.
  Pipeline(World world, const StereoCamera& camera, const PipelineOptions& options);
  ~Pipeline();

  const World& world() const;
  /// The pair and its truth. Pure; safe to call from several threads.
  RenderedFrame Render(int frame_index, std::int64_t stamp_ns,
                       const Eigen::Isometry3d& T_world_rig) const;
  /// The same where rig and actors follow no plan: neither does what blurs while the shutter is
  /// open.
  RenderedFrame Render(int frame_index, std::int64_t stamp_ns, const Shot& shot) const;
  /// The first, which adds the time that each stage took to `stages`.
  RenderedFrame RenderTimed(int frame_index, const Moment& moment, StageTimes* stages) const;
  /// The pair in colour (B, G, R), as a camera of three sensors behind the same lens takes it:
  /// exposure and gain are those of the grey picture, each band has noise of its own. The world
  /// must have colour; throws std::logic_error. Costs three shadings.
  std::array<cv::Mat3b, 2> RenderColour(int frame_index, std::int64_t stamp_ns,
                                        const Eigen::Isometry3d& T_world_rig) const;
  /// FrameTruth::depth alone: primary rays, no light.
  cv::Mat1f RenderDepth(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig) const;
  /// Linear radiance of both cameras before the sensor, in the units of the lights.
  std::array<cv::Mat1f, 2> RenderRadiance(std::int64_t stamp_ns,
                                          const Eigen::Isometry3d& T_world_rig) const;
  /// See Simulator.
  MotionTruth RenderMotion(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                           std::int64_t next_stamp_ns,
                           const Eigen::Isometry3d& T_world_rig_next) const;
  /// The parts, for whoever judges pictures by them (simulator/proof). Its sensor has the exposure
  /// that is chosen at a moment. Valid while the pipeline lives.
  Studio StudioAt(const Moment& moment) const;
  /// Runs work on the pipeline's threads; it may render.
  void Execute(const std::function<void()>& work) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace aisle::sim
