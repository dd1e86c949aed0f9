#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "simulator/common/light_progress.h"
#include "simulator/frames.h"
#include "simulator/scene/bag_poses.h"

namespace aisle::sim {

class Pipeline;
class Site;

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
  /// Called while the static light is solved (once per scene, then kept on disk).
  TellLight light_progress = {};
  /// Reads the way of a rig that follows poses in a bag; none: such a scene is refused.
  BagPoseReader bags = {};
};

/// The face of the simulator: a scene that can be photographed at any time from any pose. A frame
/// is a pure function of (scene file, assets, seed, frame index, time, pose): any frame can be
/// asked for alone, in any order. All const members may be called from several threads at once.
///
/// Frames of reference and units are those of simulator/frames.h. Where a member takes them:
///   frame_index  0 to frame_count() - 1 are the scene's frames; later ones are good, too, since
///                the scene goes on. It decides the sensor's noise and nothing else.
///   stamp_ns     from 0 on.
///   T_world_rig  anywhere, also off the route and inside of things. Must be rigid, which is not
///                checked: what a sheared pose gives is undefined.
///
/// Beside it: scene_file.h asks a scene's file without building the scene, site.h is the scene as a
/// vehicle meets it, proof/proofs.h judges what is rendered here.
class Simulator {
 public:
  /// Reads and lays out the scene, and solves its static light, which takes seconds to minutes
  /// where it is not kept on disk. Throws std::runtime_error whose what() is the whole message for
  /// the user: for mistakes of the scene file file:line:column, key, what was expected, an example;
  /// also for a pair that the rig does not have. Throws std::system_error where the machine fails:
  /// no memory, too many open files, no process to read a model in.
  static Simulator Load(const std::string& scene_file, const std::string& assets_dir,
                        const SimulatorOptions& options);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  ~Simulator();

  const RigInfo& rig() const;
  /// Of a rig with several pairs the one that is shown; "" is that of `camera`.
  const std::string& pair() const;
  /// Whether RenderColour can be asked: the scene's camera has colour, and the options wanted it.
  bool has_colour() const;
  int frame_count() const;  ///< at least 1
  double rate_hz() const;
  /// Speed above which a surface counts as moving now, from the scene file, in m/s; see FrameTruth.
  double dynamic_threshold_mps() const;
  /// By their number in label images; the first is "nothing".
  const std::vector<InstanceInfo>& instances() const;
  /// The scene file's first sentence: what the scene tests.
  const std::string& about() const;
  /// Hash of all that decides the pixels: scene, assets it uses, seed, twin. For caches and
  /// reports.
  std::uint64_t content_hash() const;
  /// The scene as a vehicle that is steered meets it; of scenes without a `drive`, too.
  const Site& site() const;

  /// Time of frame k: k / rate, rounded to whole nanoseconds.
  std::int64_t Stamp(int frame_index) const;
  /// Where the scene puts the rig at a time: T_world_rig. At the end of its route it stands; a
  /// recorded way goes on with its last velocity and turn rate.
  Eigen::Isometry3d PlannedPose(std::int64_t stamp_ns) const;

  /// The stereo pair and its truth at a time and a rig pose. While the shutter is open the rig
  /// moves as on its route, from the pose given.
  RenderedFrame Render(int frame_index, std::int64_t stamp_ns,
                       const Eigen::Isometry3d& T_world_rig) const;

  /// The same where the rig follows no plan: wherever it is and however it moves, each actor at a
  /// time of its own.
  RenderedFrame Render(int frame_index, std::int64_t stamp_ns, const Shot& shot) const;

  /// The pair, left first, in colour (B, G, R): as Render's, by a camera of three sensors. Throws
  /// std::logic_error unless has_colour().
  std::array<cv::Mat3b, 2> RenderColour(int frame_index, std::int64_t stamp_ns,
                                        const Eigen::Isometry3d& T_world_rig) const;

  /// FrameTruth::depth of a time and pose, without its picture.
  cv::Mat1f RenderDepth(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig) const;

  /// Correspondences of a frame's left image with its right camera and with the left image at
  /// another stamp and pose, usually those of the next frame; an earlier one will do.
  MotionTruth RenderMotion(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_rig,
                           std::int64_t next_stamp_ns,
                           const Eigen::Isometry3d& T_world_rig_next) const;

  /// The layout from above with the ways of rig and actors, x to the right, y up; B, G, R. Throws
  /// std::invalid_argument unless width_px > 0.
  cv::Mat3b Plan(int width_px) const;

  /// What renders the frames, for whoever judges them by its parts (simulator/pipeline.h).
  const Pipeline& pipeline() const;

 private:
  struct Impl;
  explicit Simulator(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace aisle::sim
