#include "harness/run/drive.h"

#include "harness/run/frames_ahead.h"
#include "harness/run/showing.h"

namespace aisle {

RunResult Drive(const Sequence& sequence, Estimator& estimator, const MaskMaker& masks,
                const DriveOptions& options, const FrameObserver& observer) {
  Showing showing(sequence.calibration(), sequence.rate_hz(), estimator, masks, observer);
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  FramesAhead frames(sequence, schedule, options.frames_ahead);
  for (std::size_t i = 0; i < schedule.size() && !showing.offended(); ++i) {
    const FramesAhead::Frame next = frames.Next();
    showing.Show(schedule[i], next.frame, next.made_ms, i, schedule.size());
  }
  return showing.Finish(schedule.size(), options.min_coverage);
}

}  // namespace aisle
