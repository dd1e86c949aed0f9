#include "harness/run/external_result.h"

#include "harness/score/associate.h"

namespace aisle {

RunResult ResultFromTrajectory(const Trajectory& truth, const Trajectory& estimate,
                               double min_coverage) {
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
  for (const PosePair& pair :
       Associate(truth, estimate,
                 {.rule = AssociationRule::kNearest, .max_difference_ns = half_frame_ns})) {
    FrameEstimate& frame = result.estimates[pair.truth];
    frame.state = TrackingState::kTracking;
    frame.T_world_rig = estimate[pair.estimate].T_world_rig;
    result.trajectory.live.push_back({frame.stamp_ns, *frame.T_world_rig});
  }
  result.trajectory.final = result.trajectory.live;
  const auto found = static_cast<double>(result.trajectory.live.size());
  if (found < min_coverage * static_cast<double>(truth.size())) {
    result.status = RunStatus::kLost;
    result.status_why =
        fmt::format("a pose for {} of {} frames only", result.trajectory.live.size(), truth.size());
  }
  return result;
}

}  // namespace aisle
