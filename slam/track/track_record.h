#pragma once

#include <map>
#include <utility>
#include <vector>

#include "slam/frames.h"
#include "slam/map/map.h"
#include "slam/track/track_frame.h"

namespace aisle::slam {

/// What a drive remembers of its frames: what the next one builds upon, which landmarks were found,
/// and the trajectory, every pose as seen from a keyframe, with which it moves.
class TrackRecord {
 public:
  const TrackMemory& memory() const { return memory_; }

  /// Notes a frame's pose. `goes_on`: the frame before was tracked too, so the two show a motion.
  void Note(const Map& map, const Frame& frame, const FramePose& pose, bool goes_on,
            const TrackOptions& options);

  /// Counts which landmarks should have been and were found in a frame, where the rig has moved
  /// since the last one counted. One that stands behind a person misses what the person hides at
  /// every frame and knows no more of it than after the first.
  void Count(const FramePose& pose, const LookOptions& options);

  /// Notes how the rig has been measured to move from the last frame to the one that comes, at
  /// `stamp_ns`; what was measured before it is of no use where nothing was, but for a last frame
  /// that has been noted all the same. `seen`: how it has moved since the last noted frame by the
  /// images, where anybody knows: in place of inertia while there is no velocity that it could
  /// carry on.
  void Roll(const std::optional<MeasuredMotion>& motion, std::int64_t stamp_ns,
            const InertiaOptions& inertia, const std::optional<MeasuredMotion>& seen = {});

  /// Notes a frame's pose of which nothing but the measured motion tells, or inertia (there is one
  /// of them). What was seen last is looked for in the next frame too.
  void Coast(const Map& map, std::int64_t stamp_ns, const InertiaOptions& inertia);

  /// The same of a frame that has become keyframe `id`: its landmarks are looked for as well.
  void CoastToKeyframe(const Map& map, std::int64_t stamp_ns, KeyframeId id,
                       const InertiaOptions& inertia);

  /// How often landmarks should have been and were found since this was last asked.
  std::vector<MapEdit::Count> TakeCounts();

  /// A drive begins in a map from a file, which was left at this keyframe.
  void GoOnFrom(KeyframeId reference) { memory_.reference = reference; }
  /// A map file does not hold how the rig moved: who saves one goes on without knowing, as well.
  void ForgetMotion() {
    memory_.motion.reset();
    memory_.steady_motion.reset();
    memory_.velocity.reset();
    memory_.measured.reset();
    memory_.carried.reset();
    last_frame_ns_.reset();
  }

  /// The map `before` has given way to `now`: landmarks are asked for as they are there.
  void CarryOver(const Map& before, const Map& now);

  /// Forgets the trajectory and the counts: the map they hang on is given up.
  void ForgetTrack();

  /// Every noted frame where the map now has its keyframe; where the map is in parts, those of the
  /// largest one.
  std::vector<StampedPose> Trajectory(const Map& map) const;

 private:
  struct Anchored {
    std::int64_t stamp_ns;
    KeyframeId reference;
    Eigen::Isometry3d T_reference_rig;
  };

  TrackMemory memory_;
  std::optional<std::int64_t> last_frame_ns_;    // whether or not anything is known of it
  std::optional<Eigen::Isometry3d> counted_at_;  // T_world_rig of the last frame counted
  MeasuredMotion measured_step_;                 // since the last frame, while memory_.measured is
  std::map<LandmarkId, std::pair<int, int>> counts_;  // predicted and found
  std::vector<Anchored> track_;
};

}  // namespace aisle::slam
