#pragma once

#include <optional>

#include "slam/camera/measured_motion.h"
#include "slam/map/map.h"
#include "slam/map/match_by_projection.h"
#include "slam/optimize/refine_pose.h"
#include "slam/track/both_cameras.h"
#include "slam/track/inertia.h"
#include "slam/track/local_map.h"
#include "slam/track/motion_model.h"
#include "slam/track/track_options.h"
#include "slam/track/tracking_context.h"

namespace aisle::slam {

/// What the next frame builds upon.
struct TrackMemory {
  std::int64_t stamp_ns = 0;
  KeyframeId reference;  ///< the pose is remembered as seen from it
  Eigen::Isometry3d T_reference_rig = Eigen::Isometry3d::Identity();
  std::optional<Motion> motion;
  std::optional<Motion> steady_motion;     ///< averaged over a while, see Smoothed
  std::vector<LandmarkId> landmarks;       ///< that took part in the pose
  std::optional<Velocity> velocity;        ///< as the poses tell it
  Matrix6d covariance = Matrix6d::Zero();  ///< of a small motion of the rig frame, see Retract
  bool coasted = false;  ///< the pose is where measurement or inertia led, and nobody has seen it
  /// The way from this pose to the frame that comes, as measured. Its covariance is of the pose
  /// there: this one's, carried along, and that of the way itself. Nothing where the way is not
  /// measured without a gap.
  std::optional<MeasuredMotion> measured;
  /// The same where nothing is measured: as inertia carries the rig on or, while no velocity is
  /// known, as the images have shown it. Nothing where neither tells.
  std::optional<MeasuredMotion> carried;

  /// The way by what is known of it; something must be.
  const MeasuredMotion& Way() const { return measured ? *measured : *carried; }
  /// Where the rig was: T_world_rig.
  Eigen::Isometry3d PoseIn(const Map& map) const { return map.PoseOf(reference) * T_reference_rig; }
};

/// A frame's place in the map.
struct FramePose {
  RefinedPose pose;            ///< inlier[i] tells of matches[i], then of right_matches
  std::vector<Match> matches;  ///< features to landmarks, by rising feature
  std::vector<Measurement> measurements = {};  ///< of matches[i]; or none: those of the frame
  std::vector<Match> right_matches = {};  ///< of landmarks that the right camera alone has shown
  LocalMap local;
  std::vector<LandmarkId> expected;  ///< landmarks that should have been seen
  int in_view = 0;  ///< landmarks; with those that should not, as a mask hides them
  /// As the images alone have told the pose, where inertia has had a say in it.
  std::optional<RefinedPose> seen = {};
};

/// How many landmarks the left camera has found where the pose has them.
int LeftInliers(const FramePose& found);

/// Whether a pose explains TrackOptions::convincing_share of what is in view from it. What a mask
/// hides counts: of a few landmarks around somebody who hides the rest chance may explain enough.
bool IsConvincing(const FramePose& found, const TrackOptions& options);

/// Finds the frame in the map: from where motion predicts it, from where it was, or by recognising
/// the reference keyframe; the first pose that convinces (TrackOptions::convincing_share), else the
/// first found at all; refined with everything around. Nothing if lost.
std::optional<FramePose> TrackFrame(const PlainContext& context, const TrackMemory& memory);

/// Refines a first pose with all landmarks around it; nothing with fewer inliers than
/// TrackOptions::least_map_inliers.
std::optional<FramePose> RefineInLocalMap(const PlainContext& context,
                                          const Eigen::Isometry3d& T_rig_world,
                                          const std::vector<LandmarkId>& landmarks,
                                          const RefinePoseOptions& refine);

/// Refines a pose that corners have found by where exactly their patches are. Seen from far off
/// where it was made, the map itself is less exact than those: where they reject too many of the
/// landmarks that the pose stands on, it stays as it is.
void Sharpen(const PlainContext& context, const RefinePoseOptions& refine, FramePose* found);

/// What should be seen from a pose of the surroundings of the frame that `memory` is of.
std::vector<Expected> ExpectAround(const PlainContext& context, const TrackMemory& memory,
                                   const Eigen::Isometry3d& T_rig_world);

/// The landmarks of the matches that a pose keeps.
std::vector<LandmarkId> Inliers(const std::vector<Match>& matches, const RefinedPose& pose);

/// Finds a frame that comes after a while without sight: landmarks are looked for around where the
/// steady motion leads, the wider the longer the while, and a pose that they agree on is believed
/// if it lies near there. Nothing where no motion is known or the while was too long.
std::optional<FramePose> FindAgain(const PlainContext& context, const TrackMemory& memory);

/// Whether a frame that comes after a while without sight can be where it was found: racks look
/// alike, and no rig is at the next one at once. True where the steady motion tells nothing.
bool CanBeThere(const PlainContext& context, const TrackMemory& memory, const FramePose& found);

/// Finds the frame by recognising one keyframe, without knowing where it might be.
std::optional<FramePose> LocateByKeyframe(const PlainContext& context, KeyframeId keyframe);

/// The next keyframe as a tracked frame becomes it: seen from the pose's reference, with the
/// landmarks that the pose kept and where it has found them.
Keyframe KeyframeOf(const Map& map, const std::shared_ptr<const Frame>& frame,
                    const FramePose& pose);

/// The pose of the frame that keyframe `id` was made of, with all its landmarks taking part.
FramePose PoseOfKeyframe(const Map& map, KeyframeId id);

}  // namespace aisle::slam
