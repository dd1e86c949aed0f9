#pragma once

#include <optional>
#include <string>

#include "harness/common/stopwatch.h"
#include "harness/run/drive.h"

namespace aisle {

/// One estimator being shown frames, one after the other, by whoever decides which: an open-loop
/// drive or a closed one. Checks everything that it says, and keeps the facts that the scores need.
class Showing {
 public:
  /// The estimator's masks are made by `masks`; `observer` may be empty. All must outlive this.
  Showing(const StereoCalibration& calibration, double rate_hz, Estimator& estimator,
          const MaskMaker& masks, const FrameObserver& observer);

  /// Shows a frame: number `index` of about `count`. What the estimator said of it, or null where
  /// it committed an offence, after which nothing more may be shown.
  const FrameEstimate* Show(const FrameRequest& request, const SequenceFrame& shown, double made_ms,
                            std::size_t index, std::size_t count);
  bool offended() const { return !why_.empty(); }

  /// Ends the run. Of `frames` there had to be a pose for `min_coverage` of them.
  RunResult Finish(std::size_t frames, double min_coverage);

 private:
  void Offend(RunStatus status, const std::string& why);

  const Stopwatch whole_;
  const StereoCalibration calibration_;
  const double frame_ms_;
  Estimator& estimator_;
  const MaskMaker& masks_;
  const FrameObserver& observer_;
  RunResult result_;
  std::optional<Eigen::Isometry3d> T_world_previous_;
  bool ever_rejected_ = false;
  RunStatus status_ = RunStatus::kOk;
  std::string why_;  ///< of the offence; empty: none
};

}  // namespace aisle
