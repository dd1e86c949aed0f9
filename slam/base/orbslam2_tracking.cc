#include "slam/base/orbslam2_tracking.h"

#include "slam/common/seconds.h"
#include "slam/map/match_by_projection.h"
#include "slam/map/successor.h"
#include "slam/track/orbslam2_keyframe.h"

namespace aisle::slam {
namespace {

/// The features of a keyframe that name landmarks.
std::vector<Match> MatchesOf(const Keyframe& keyframe) {
  std::vector<Match> matches;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    if (!keyframe.landmarks[i].valid()) continue;
    matches.push_back({keyframe.landmarks[i], static_cast<int>(i), 0});
  }
  return matches;
}

std::vector<Match> InliersOf(const FramePose& pose) {
  std::vector<Match> matches;
  for (std::size_t i = 0; i < pose.matches.size(); ++i) {
    if (pose.pose.inlier[i]) matches.push_back(pose.matches[i]);
  }
  return matches;
}

}  // namespace

std::optional<FramePose> OrbSlam2Tracking::Find(const std::shared_ptr<const Frame>& frame,
                                                const DriveState& drive) {
  const OrbSlam2Context context{drive.map, *frame, camera_, levels_, options_};
  const TrackMemory& last = drive.memory;
  if (drive.lost) {
    auto found = OrbSlam2Relocalise(context, KeyframesToAsk(drive.map, *frame, last.reference,
                                                            drive.places, drive.frame_number));
    if (found) found_ = {drive.frame_number, frame->stamp_ns};  // no keyframe until it has settled
    return found;
  }
  memory_.frames_since_found = static_cast<int>(drive.frame_number - found_.frame_number);
  memory_.seconds_since_found = SecondsBetween(found_.stamp_ns, frame->stamp_ns);
  return OrbSlam2Track(context, last.PoseIn(drive.map), drive.map.StandIn(last.reference), memory_);
}

KeyframeVerdict OrbSlam2Tracking::NeedsKeyframe(const Map& map, const Frame& frame,
                                                const FramePose& pose,
                                                const MapperState& mapper) const {
  if (mapper.closing) return {};
  const OrbSlam2Verdict verdict = OrbSlam2NeedsKeyframe(
      map, frame, pose, camera_,
      {.seconds_since_keyframe = SecondsBetween(keyframe_stamp_ns_, frame.stamp_ns),
       .seconds_since_found = SecondsBetween(found_.stamp_ns, frame.stamp_ns),
       .mapper_idle = mapper.idle,
       .waiting = mapper.waiting},
      options_);
  return {.taken = verdict.taken, .hurry = verdict.wanted && !mapper.idle};
}

MapEdit OrbSlam2Tracking::MakeKeyframe(const Map& map, const std::shared_ptr<const Frame>& frame,
                                       const FramePose& pose) const {
  return OrbSlam2Keyframe(map, frame, pose, camera_, options_);
}

std::optional<NewPart> OrbSlam2Tracking::Begin(const std::shared_ptr<const Frame>& frame,
                                               const DriveState&) const {
  const auto edit = OrbSlam2FirstKeyframe(frame, camera_, options_);
  return edit ? std::optional(NewPart{*edit, false}) : std::nullopt;
}

bool OrbSlam2Tracking::GivesUp(const Map& map) const {
  return std::ssize(map.keyframes()) <= options_.least_keyframes_to_keep;
}

void OrbSlam2Tracking::Note(const std::shared_ptr<const Frame>& frame, const FramePose* pose,
                            std::optional<KeyframeId> keyframe, const DriveState& drive) {
  if (!pose) {
    memory_ = {};
    return;
  }
  const bool goes_on = memory_.frame != nullptr;
  if (!goes_on) found_ = {drive.frame_number, frame->stamp_ns};  // the first, that is no search's
  memory_.T_now_before.reset();
  if (goes_on) {
    const TrackMemory& last = drive.memory;
    memory_.T_now_before =
        pose->pose.T_rig_world * drive.map.PoseOf(last.reference) * last.T_reference_rig;
  }
  memory_.frame = frame;
  memory_.matches = keyframe ? MatchesOf(drive.map.At(*keyframe)) : InliersOf(*pose);
  if (keyframe) keyframe_stamp_ns_ = frame->stamp_ns;
}

void OrbSlam2Tracking::CarryOver(const Map& before, const Map& now) {
  for (Match& match : memory_.matches) match.landmark = Successor(before, now, match.landmark);
  std::erase_if(memory_.matches, [](const Match& match) { return !match.landmark.valid(); });
}

}  // namespace aisle::slam
