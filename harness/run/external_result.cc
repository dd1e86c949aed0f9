#include "harness/run/external_result.h"

#include <algorithm>

#include "harness/common/seconds.h"
#include "harness/score/stamp_unit.h"

namespace aisle {
namespace {

Trajectory Later(Trajectory trajectory, std::int64_t by_ns) {
  for (StampedPose& pose : trajectory) pose.stamp_ns += by_ns;
  return trajectory;
}

std::string Span(const Trajectory& trajectory) {
  const auto seconds = [](const StampedPose& pose) { return ToSeconds(pose.stamp_ns); };
  return fmt::format("{:.3f} to {:.3f} s", seconds(trajectory.front()), seconds(trajectory.back()));
}

/// What is wrong with a trajectory of which few poses found a frame, or an empty string; there are
/// more poses than frames where a system answers faster than the camera. Stamps are the system's.
std::string ForeignStamps(const Trajectory& truth, const Trajectory& estimate,
                          const std::vector<PosePair>& pairs) {
  if (estimate.empty() || 2 * pairs.size() >= std::min(estimate.size(), truth.size())) return {};
  const auto factor = StampFactor(truth, estimate, pairs);
  return fmt::format(
      "{} of {} poses have a frame's timestamp: they range from {}, but the dataset's frames from "
      "{}{}",
      pairs.size(), estimate.size(), Span(estimate), Span(truth),
      factor ? "; " + NoteOnStamps(*factor) : "");
}

}  // namespace

RunResult ResultFromTrajectory(const Trajectory& truth, const Trajectory& estimate,
                               double min_coverage, std::int64_t epoch_ns) {
  RunResult result;
  result.truth = truth;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    FrameFacts facts;
    facts.stamp_ns = truth[i].stamp_ns;
    facts.T_world_rig = truth[i].T_world_rig;
    result.facts.push_back(facts);
    FrameEstimate frame;
    frame.id = static_cast<std::int64_t>(i);
    frame.stamp_ns = truth[i].stamp_ns;
    frame.state = TrackingState::kLost;
    result.estimates.push_back(frame);
  }
  // The truth's frames decide what half a frame is: key-frame trajectories are sparse.
  const std::int64_t half_frame_ns = MedianIntervalNs(truth) / 2;
  const std::vector<PosePair> pairs = Associate(
      truth, estimate, {.rule = AssociationRule::kNearest, .max_difference_ns = half_frame_ns});
  for (const PosePair& pair : pairs) {
    FrameEstimate& frame = result.estimates[pair.truth];
    frame.state = TrackingState::kTracking;
    frame.T_world_rig = estimate[pair.estimate].T_world_rig;
    result.trajectory.live.push_back({frame.stamp_ns, *frame.T_world_rig});
  }
  result.trajectory.final = result.trajectory.live;
  const std::string foreign =
      ForeignStamps(Later(truth, epoch_ns), Later(estimate, epoch_ns), pairs);
  if (static_cast<double>(pairs.size()) < min_coverage * static_cast<double>(truth.size())) {
    result.status = RunStatus::kLost;
    result.status_why = fmt::format("poses for only {} of {} frames{}{}", pairs.size(),
                                    truth.size(), foreign.empty() ? "" : "; ", foreign);
  } else if (!foreign.empty()) {  // scores would speak of the few that happen to be near a frame
    result = ResultFromTrajectory(truth, {}, 0);
    result.status = RunStatus::kInvalid;
    result.status_why = foreign;
  }
  return result;
}

}  // namespace aisle
