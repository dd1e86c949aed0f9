#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "harness/contract/sequence.h"
#include "harness/contract/twin.h"
#include "harness/io/dataset.h"
#include "harness/plugs/light_teller.h"

namespace aisle {

struct SimulatedSequenceOptions {
  std::string scene_file;
  std::string scene_name;  ///< for reports, e.g. "paper/scene2"
  std::string assets_dir;
  std::string twin = twin::kLive;  ///< one of TwinNames()
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has; never changes a pixel
  std::string isa = "avx2";
  double light_spacing = 1;  ///< how much further apart than usual the static light's points lie
  /// Estimators take rectified pairs, so a scene with a distorted lens is refused unless this says
  /// that the pictures go elsewhere.
  bool any_lens = false;
  TellLightWork light_progress = {};  ///< beside a bar on a terminal
};

/// What the proofs say of one frame, and the sentence about what failed, or none.
struct FrameProof {
  double raster_agreement = 0;  ///< share of pixels, the worse camera
  double stereo_median_px = 0, flow_median_px = 0;
  /// Grey levels, rms: from frame to frame on things at rest, and what flickers on the others.
  double static_change_grey = 0, mover_flicker_grey = 0, shadow_flicker_grey = 0;
  std::string failure;
};

/// A scene opened for writing a dataset. The functions are valid while the sequence lives.
struct SimulationForExport {
  std::unique_ptr<Sequence> sequence;
  std::uint64_t content_hash = 0;
  /// Left and right in colour (B, G, R); none where the scene's camera has no colour.
  std::function<std::array<cv::Mat3b, 2>(const FrameRequest& frame)> colour = {};
  std::string pair = {};  ///< of a rig with several pairs, the one that is shown
  LensCalibration lens;
  std::vector<LabelInfo> labels;
  /// Where the camera is mounted: base as REP 103 has it, x ahead, y to the left, z up.
  Eigen::Isometry3d T_base_rig = Eigen::Isometry3d::Identity();
  PathOfRig path;
  /// Correspondences to the next frame of the scene, which for the last is the one that would come.
  std::function<FrameMotion(const FrameRequest& frame)> motion;
  /// The same to any other time and pose.
  std::function<FrameMotion(const FrameRequest& from, const FrameRequest& to)> motion_between;
  std::function<FrameProof(const FrameRequest& frame)> prove;
};

/// `pair` is the one of the rig's pairs that is shown; empty: the scene's choice. Throws as
/// OpenSimulation does. Takes any lens.
SimulationForExport OpenForExport(const SimulatedSequenceOptions& options,
                                  const std::string& pair = "");

/// Depth of the left camera at any frame, in metres, inf where nothing was hit: what stored frames
/// are without. Throws as OpenSimulation does.
std::function<cv::Mat1f(const FrameRequest&)> OpenDepth(const SimulatedSequenceOptions& options);

/// The versions of a scene: live (as written), empty (no actors), frozen (all stand still), and
/// none, low, mid, high: as written at that level of dynamics.
const std::vector<std::string>& TwinNames();

/// A scene as a sequence. `content_hash` and `path` may be null; `path` becomes the pose of the rig
/// at any time, valid while the sequence lives. Throws InputError with the simulator's own message
/// (file:line:column) for a bad scene.
std::unique_ptr<Sequence> OpenSimulation(const SimulatedSequenceOptions& options,
                                         std::uint64_t* content_hash = nullptr,
                                         PathOfRig* path = nullptr);

/// The layout of a scene from above with the ways of rig and actors, and what the scene says it
/// tests. Throws InputError likewise.
struct ScenePlan {
  cv::Mat3b picture;
  std::string about;
};
ScenePlan DrawScenePlan(const SimulatedSequenceOptions& options, int width_px);

/// Every mistake in a scene file, models that are not there among them, one message each.
std::vector<std::string> CheckScene(const std::string& scene_file);

/// A scene's file and those it extends, nearest first: what it holds changes with them alone.
std::vector<std::string> FilesOfScene(const std::string& scene_file);

/// All of a scene that decides the frames of that twin, as text: scenes of equal essence have equal
/// frames for the same seed, assets and program. Throws InputError.
std::string EssenceOfScene(const std::string& scene_file, const std::string& twin);

/// The hall that a seed of it is in, by its file's name; empty where the scene says itself what is
/// there. Throws InputError for a bad scene.
std::string HallOfScene(const std::string& scene_file, std::uint64_t seed);

/// Frames of a scene as its file says. Throws InputError for a bad scene.
std::int64_t CountSceneFrames(const std::string& scene_file);

}  // namespace aisle
