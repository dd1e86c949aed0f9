#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "simulator/calibration/stereo_model.h"
#include "simulator/common/light_progress.h"
#include "simulator/frames.h"
#include "simulator/import_model.h"
#include "simulator/scene/bag_poses.h"
#include "simulator/world/ground.h"

namespace aisle::sim {

/// Which version of a scene to play.
enum class Twin {
  kLive,    ///< as written
  kEmpty,   ///< actors removed
  kFrozen,  ///< actors stand where they stand at time 0
  // As written, but for the level of dynamics: only actors of at most that level.
  kNone,
  kLow,
  kMid,
  kHigh,
};

struct SimulatorOptions {
  std::uint64_t seed = 1;
  Twin twin = Twin::kLive;
  std::string pair = {};  ///< of the rig's pairs the one that is shown; empty: the scene's choice
  bool colour = false;    ///< RenderColour will be asked for, where the scene's camera has colour
  int threads = 0;        ///< 0: as many as the machine has; the bytes are the same for any number
  std::string isa = "avx2";  ///< Embree's instruction set; "native" lets Embree choose
  /// How much further apart than usual the points of the static light lie: over 1, a draft.
  double light_spacing = 1;
  bool keep_light = true;  ///< the solved static light is read from and kept on disk
  /// Told while the static light is solved (once per scene, then kept on disk).
  TellLight light_progress = {};
};

/// The face of the simulator: a scene that can be photographed at any time from any pose. A frame
/// is a pure function of (scene file, assets, seed, frame index, time, pose): any frame can be
/// asked for alone, in any order.
class Simulator {
 public:
  /// Reads and lays out the scene. Throws std::runtime_error whose what() is the whole message for
  /// the user: file:line:column, key, what was expected, an example.
  static Simulator Load(const std::string& scene_file, const std::string& assets_dir,
                        const SimulatorOptions& options);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  ~Simulator();

  const RigInfo& rig() const;
  int frame_count() const;
  double rate_hz() const;
  /// Speed above which a surface counts as moving now, from the scene file, in m/s; see FrameTruth.
  double dynamic_threshold_mps() const;
  const std::vector<InstanceInfo>& instances() const;
  /// Hash of all that decides the pixels: scene, assets it uses, seed, twin. For caches and
  /// reports.
  std::uint64_t content_hash() const;

  /// Time of frame k: k / rate, in whole nanoseconds from 0.
  std::int64_t Stamp(int frame_index) const;
  /// Where the scene's route puts the rig at a time: T_world_rig.
  Eigen::Isometry3d PlannedPose(std::int64_t stamp_ns) const;

  /// The layout from above with the ways of rig and actors, x to the right, y up; BGR.
  cv::Mat3b Plan(int width_px) const;
  /// Its first sentence: what the scene tests.
  const std::string& about() const;

  /// The stereo pair and its truth at a time and a rig pose. `frame_index` seeds the sensor noise.
  /// While the shutter is open the rig moves as on its route, from the pose given. Safe to call
  /// from several threads.
  RenderedFrame Render(int frame_index, std::int64_t stamp_ns,
                       const Eigen::Isometry3d& T_world_rig) const;

  /// The same where the rig follows no plan: wherever it is and however it moves, each actor at a
  /// time of its own.
  RenderedFrame Render(int frame_index, std::int64_t stamp_ns, const Shot& shot) const;

  /// Of a rig with several pairs the one that is shown; "" is that of `camera`.
  const std::string& pair() const;
  /// Whether the scene's camera has colour too.
  bool has_colour() const;
  /// The pair in colour (B, G, R) where it has: as Render's, by a camera of three sensors. Throws
  /// std::logic_error where it has not.
  std::array<cv::Mat3b, 2> RenderColour(int frame_index, std::int64_t stamp_ns,
                                        const Eigen::Isometry3d& T_world_rig) const;

  /// FrameTruth::depth of a time and pose, without its picture.
  cv::Mat1f RenderDepth(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig) const;

  /// What the scene's `drive` says; `there` is false where it has none.
  const DriveSpec& drive() const;
  /// The scene seen from above: way, things, actors. Things and actors only where it has a `drive`.
  const Ground& ground() const;
  /// What the planned way may ask of the rig.
  const RouteLimits& limits() const;
  /// T_world_rig of the rig's vehicle at a place of the floor; its jolts are those of that time.
  Eigen::Isometry3d RigPoseAt(const GroundPose& vehicle, std::int64_t stamp_ns) const;
  /// T_vehicle_rig: where the camera is mounted, without any jolt.
  Eigen::Isometry3d Mount() const;

  /// Correspondences of a frame with its right camera and with the left image at a next stamp and
  /// pose.
  MotionTruth RenderMotion(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                           std::int64_t next_stamp_ns,
                           const Eigen::Isometry3d& T_world_rig_next) const;

  /// Proves one planned frame: its truth against an independent rasteriser and by warping it to the
  /// right camera and to the next frame, its picture by warping it to the next two.
  VerifyReport Verify(int frame_index) const;

  /// Times Render over `frames` frames spread over the scene, and the bare primary rays of the same
  /// frames, interleaved so that both meet the same machine.
  RenderBench Bench(int frames) const;

  /// Renders one planned frame and hashes what its stages made.
  StageHashes HashStages(int frame_index) const;

  /// Renders one planned left image with the nightly light and by path tracing, `samples` paths a
  /// pixel: minutes. Both are compared at a size reduced by a whole factor, which leaves the paths'
  /// noise the smaller.
  LightCheck CheckLight(int frame_index, int samples, int reduce) const;

  /// The same of a frame, and how it changes to the next one, whose paths have the same seeds.
  LightChangeCheck CheckLightChange(int frame_index, int samples, int reduce) const;

 private:
  struct Impl;
  explicit Simulator(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

struct ForeignOptions {
  int samples = 256;  ///< paths a pixel
  int depth = 8;      ///< surfaces a path may touch; 1 shows luminaires alone
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
};

/// Path-traces a scene of another renderer (simulator/foreign tells the dialect), each colour by
/// itself: linear radiance, channels in OpenCV's order B, G, R. Throws std::runtime_error: "file:
/// key: what is wrong".
cv::Mat3f TraceForeignScene(const std::string& file, const ForeignOptions& options);

/// Every mistake in a scene file, one message each (empty: the file is good). Where `assets_dir` is
/// given, models that its manifest does not have are mistakes too; none is opened.
std::vector<std::string> CheckSceneFile(const std::string& scene_file,
                                        const std::string& assets_dir = "");

/// Frames of a scene as its file says. Throws as Simulator's constructor does.
int CountSceneFrames(const std::string& scene_file);

/// Whether the scene has a `drive`. Throws likewise.
bool IsDriveScene(const std::string& scene_file);

/// The scene's `drive`, or that of a scene which says nothing of it. Throws likewise.
DriveSpec DriveOfScene(const std::string& scene_file);

/// A scene's file and those it extends, nearest first: the scene is what they hold. Of a file with
/// mistakes, as far as they can be followed.
std::vector<std::string> FilesOfScene(const std::string& scene_file);

/// The hall that a seed of a scene is in, by its file's name ("cold_store"); empty where the scene
/// says itself what is there. Throws as Simulator::Load does.
std::string HallOfScene(const std::string& scene_file, std::uint64_t seed);

/// All of a scene that decides the frames of that twin, as text: neither what it is about nor who
/// is not to be seen. Scenes of equal essence have equal frames for the same seed, assets and
/// program. Throws as Simulator::Load does where the file cannot be read.
std::string EssenceOfScene(const std::string& scene_file, Twin twin);

}  // namespace aisle::sim
