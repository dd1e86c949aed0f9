#include "harness/run/drive.h"

#include "harness/run/frames_ahead.h"
#include "harness/run/showing.h"

namespace aisle {
namespace {

/// Who ended before its time has no pose for the frames that it was never shown: they are truth to
/// be covered all the same, where it is known and was of all that was shown.
void AddNeverShown(const std::vector<FrameRequest>& schedule, RunResult* result) {
  const std::size_t shown = result->facts.size();
  if (shown == 0 || result->truth.size() != shown) return;
  for (std::size_t i = shown; i < schedule.size(); ++i) {
    if (!schedule[i].pose_known) continue;
    result->truth.push_back({schedule[i].stamp_ns, schedule[i].T_world_rig});
  }
}

}  // namespace

RunResult Drive(const Sequence& sequence, Estimator& estimator, const MaskMaker& masks,
                const DriveOptions& options, const FrameObserver& observer) {
  Showing showing(sequence.calibration(), sequence.rate_hz(), estimator, masks, observer);
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  FramesAhead frames(sequence, schedule, options.frames_ahead);
  for (std::size_t i = 0; i < schedule.size() && !showing.offended(); ++i) {
    const FramesAhead::Frame next = frames.Next();
    showing.Show(schedule[i], next.frame, next.made_ms, i, schedule.size());
  }
  RunResult result = showing.Finish(schedule.size(), options.min_coverage);
  AddNeverShown(schedule, &result);
  return result;
}

}  // namespace aisle
