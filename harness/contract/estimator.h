#pragma once

#include <filesystem>
#include <stdexcept>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"

namespace aisle {

/// What an estimator wants to be told besides the images.
enum class MaskSource {
  kNone,
  kDynamic,  ///< truth's mask of what moves now (`oracle`)
  kActors,   ///< all that may move, whether it does or not (`semantic`)
};

/// The socket for a system under test: frames in, poses out. Truth never passes through it.
///
/// Frames of reference. `T_world_rig` maps rig coordinates to world coordinates, in metres; rig is
/// the left rectified camera (x right, y down, z forward). The world is the estimator's own: its
/// origin and heading are free (usually the first rig pose), its scale is not, and it does not move
/// while MapIdOf (map_id.h) stays the same. Scores align it with truth by one rigid motion.
///
/// Order of calls. One instance serves one drive: Process for every frame, stamps rising, then
/// Finish once, then perhaps SaveMap. All from one thread, though not always the same one. Other
/// instances may live beside it in the process and must not be noticed.
///
/// Ownership. The images and the mask are the caller's and are used again once Process has
/// returned: whoever needs them later (a background thread, say) clones them, and nobody writes to
/// them. What comes back belongs to the caller.
///
/// Errors. A hard frame (black, blurred, without a feature, all of it masked) is no error: it comes
/// back as kLost or kInitializing without a pose. An exception says that the system itself is
/// broken; it ends the run as `crashed`, and the instance is destroyed without another call.
///
/// Same frames, same masks: the same poses to the bit, whatever the machine is busy with. A system
/// that cannot promise it still runs; its scores then differ from night to night.
///
/// harness/run/conformance.h holds any estimator to all of this.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// What can be said of this frame, knowing it and those before. `id` and `stamp_ns` are the
  /// frame's own. `T_world_rig` is present exactly where the system stands by a pose: state
  /// kTracking. Poses already handed out are not taken back here; what later frames taught belongs
  /// in Finish. The mask of `regions` is empty or of the image's size, 0 or 255. `keypoints` lie in
  /// the left image (the centre of pixel (0, 0) is u = 0, v = 0); `keypoint_is_inlier` is empty or
  /// has one entry each. Counts, stage times and regions may be empty: what is not told is not
  /// scored. Either image of `mask` may be empty, which rejects nothing there.
  virtual FrameEstimate Process(const StereoFrame& frame, const ExternalMask& mask) = 0;

  /// Ends the run: the final track, after all optimisation, over the frames that the system stands
  /// by. Stamps rise and are those of frames that were processed; frames may be missing, which
  /// costs coverage. May take its time: background work is waited for here.
  virtual Trajectory Finish() = 0;

  /// Writes the map for a later drive. Throws std::runtime_error where it cannot: apart from
  /// Finish, so that the trajectory is safe by then.
  virtual void SaveMap(const std::filesystem::path& file) {
    throw std::runtime_error(file.string() + ": this system keeps no map");
  }
};

}  // namespace aisle
