#include "slam/track/track_record.h"

#include <numbers>

#include "slam/common/seconds.h"
#include "slam/map/successor.h"

namespace aisle::slam {
namespace {

/// How the rig moves that is found after coasting. The step from where it was guessed to be is
/// mostly what was wrong with the guess: it moves as was measured, else as the velocity has learned
/// from that step.
std::optional<Motion> MotionAfterCoasting(const TrackMemory& before, const Velocity& learned,
                                          double seconds) {
  if (before.measured) {
    return EstimateMotion(Eigen::Isometry3d::Identity(), before.measured->T_now_before.inverse(),
                          seconds);
  }
  return before.velocity ? Motion{learned.per_second} : before.motion;
}

/// The step from the last frame as the images tell it: of what the velocity itself has had a say in
/// it would learn that it was right.
MeasuredMotion StepAsSeen(const Map& map, const TrackMemory& before, const FramePose& now) {
  const RefinedPose& seen = now.seen ? *now.seen : now.pose;
  return Compose({Eigen::Isometry3d::Identity(), before.covariance},
                 {seen.T_rig_world * before.PoseIn(map), seen.covariance});
}

}  // namespace

void TrackRecord::Note(const Map& map, const Frame& frame, const FramePose& pose, bool goes_on,
                       const TrackOptions& options) {
  const Eigen::Isometry3d T_world_rig = pose.pose.T_rig_world.inverse();
  const double seconds = SecondsBetween(memory_.stamp_ns, frame.stamp_ns);
  std::optional<Motion> motion;
  std::optional<Velocity> velocity;
  if (goes_on) {
    const Eigen::Isometry3d T_world_last = memory_.PoseIn(map);
    motion = EstimateMotion(T_world_last, T_world_rig, seconds);
    if (motion)
      velocity = Learn(memory_.velocity, StepAsSeen(map, memory_, pose), seconds, options.inertia);
    if (motion && memory_.coasted) motion = MotionAfterCoasting(memory_, *velocity, seconds);
  }
  memory_.velocity = velocity;
  memory_.covariance = pose.pose.covariance;
  memory_.coasted = false;
  memory_.stamp_ns = frame.stamp_ns;
  memory_.reference = pose.local.reference;
  memory_.T_reference_rig = map.PoseOf(memory_.reference).inverse() * T_world_rig;
  memory_.steady_motion = motion ? std::optional(Smoothed(memory_.steady_motion, *motion, seconds,
                                                          options.dead_reckoning.half_life_s))
                                 : std::nullopt;
  memory_.motion = motion;
  memory_.measured = MeasuredMotion{Eigen::Isometry3d::Identity(), pose.pose.covariance};
  memory_.landmarks = InliersOfBoth(pose.matches, pose.right_matches, pose.pose);
  track_.push_back({frame.stamp_ns, memory_.reference, memory_.T_reference_rig});
}

void TrackRecord::Count(const FramePose& pose, const LookOptions& options) {
  const Eigen::Isometry3d T_world_rig = pose.pose.T_rig_world.inverse();
  if (counted_at_) {
    const Eigen::Isometry3d moved = counted_at_->inverse() * T_world_rig;
    const double turned_deg = Eigen::AngleAxisd(moved.linear()).angle() * 180 / std::numbers::pi;
    if (moved.translation().norm() < options.least_m && turned_deg < options.least_deg) return;
  }
  counted_at_ = T_world_rig;
  for (const LandmarkId id : pose.expected) ++counts_[id].first;
  for (const LandmarkId id : InliersOfBoth(pose.matches, pose.right_matches, pose.pose))
    ++counts_[id].second;
}

void TrackRecord::Roll(const std::optional<MeasuredMotion>& motion, std::int64_t stamp_ns,
                       const InertiaOptions& inertia, const std::optional<MeasuredMotion>& seen) {
  memory_.carried.reset();
  const MeasuredMotion none{Eigen::Isometry3d::Identity(), memory_.covariance};
  // Where it was at the last frame is known however that was told: by the images, by what had been
  // measured, or by inertia for a frame of which nothing was.
  if (last_frame_ns_ == memory_.stamp_ns && !memory_.measured) memory_.measured = none;
  last_frame_ns_ = stamp_ns;
  if (memory_.measured && motion) {
    memory_.measured = Compose(*memory_.measured, *motion);
    measured_step_ = *motion;
    return;
  }
  memory_.measured.reset();
  const double seconds = SecondsBetween(memory_.stamp_ns, stamp_ns);
  if (motion || seconds <= 0 || seconds > inertia.longest_s) return;
  const std::optional<MeasuredMotion> step =
      memory_.velocity ? Carry(*memory_.velocity, seconds, inertia) : seen;
  if (step) memory_.carried = Compose(none, *step);
}

void TrackRecord::Coast(const Map& map, std::int64_t stamp_ns, const InertiaOptions& inertia) {
  const MeasuredMotion way = memory_.Way();
  const Eigen::Isometry3d T_world_last = memory_.PoseIn(map);
  const Eigen::Isometry3d T_world_rig = Normalized(T_world_last * way.T_now_before.inverse());
  const double seconds = SecondsBetween(memory_.stamp_ns, stamp_ns);
  memory_.motion = EstimateMotion(T_world_last, T_world_rig, seconds);
  memory_.stamp_ns = stamp_ns;
  memory_.T_reference_rig = map.PoseOf(memory_.reference).inverse() * T_world_rig;
  memory_.covariance = way.covariance;
  memory_.coasted = true;
  if (memory_.measured) {
    memory_.measured->T_now_before.setIdentity();
    memory_.velocity = Learn(memory_.velocity, measured_step_, seconds, inertia);
  } else if (memory_.velocity) {
    memory_.velocity = Coasted(*memory_.velocity, seconds, inertia);
  }
  track_.push_back({stamp_ns, memory_.reference, memory_.T_reference_rig});
}

void TrackRecord::CoastToKeyframe(const Map& map, std::int64_t stamp_ns, KeyframeId id,
                                  const InertiaOptions& inertia) {
  Coast(map, stamp_ns, inertia);
  const Keyframe& keyframe = map.At(id);
  memory_.reference = id;
  memory_.T_reference_rig.setIdentity();
  for (const LandmarkId landmark : keyframe.landmarks) {
    if (landmark.valid()) memory_.landmarks.push_back(landmark);
  }
  track_.back() = {stamp_ns, memory_.reference, memory_.T_reference_rig};
}

std::vector<MapEdit::Count> TrackRecord::TakeCounts() {
  std::vector<MapEdit::Count> counts;
  for (const auto& [landmark, count] : counts_) {
    counts.push_back({landmark, count.first, count.second});
  }
  counts_.clear();
  return counts;
}

void TrackRecord::CarryOver(const Map& before, const Map& now) {
  std::map<LandmarkId, std::pair<int, int>> counts;
  for (const auto& [id, count] : counts_) {
    const LandmarkId successor = Successor(before, now, id);
    if (!successor.valid()) continue;
    counts[successor].first += count.first;
    counts[successor].second += count.second;
  }
  counts_ = std::move(counts);
  for (LandmarkId& id : memory_.landmarks) id = Successor(before, now, id);
}

void TrackRecord::ForgetTrack() {
  counts_.clear();
  track_.clear();
}

std::vector<StampedPose> TrackRecord::Trajectory(const Map& map) const {
  std::vector<StampedPose> poses;
  if (map.empty()) return poses;
  const KeyframeId largest = LargestPart(map);
  const std::map<KeyframeId, KeyframeId> roots = Roots(map);
  for (const Anchored& anchored : track_) {
    if (roots.at(map.StandIn(anchored.reference)) != largest) continue;
    poses.push_back({anchored.stamp_ns, map.PoseOf(anchored.reference) * anchored.T_reference_rig});
  }
  return poses;
}

}  // namespace aisle::slam
