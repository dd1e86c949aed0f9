#include "harness/run/drive.h"

#include <sys/resource.h>

#include "harness/common/stopwatch.h"
#include "harness/run/frames_ahead.h"
#include "harness/score/difficulty.h"
#include "harness/score/masks.h"

namespace aisle {
namespace {

/// What ended the run, if anything did.
struct Offence {
  RunStatus status = RunStatus::kOk;
  std::string why;
};

/// An empty reason is no offence.
Offence Offends(RunStatus status, const std::string& why) {
  return why.empty() ? Offence{} : Offence{status, why};
}

bool IsRigid(const Eigen::Isometry3d& pose) {
  constexpr double kTolerance = 1e-3;
  if (!pose.matrix().allFinite()) return false;
  const Eigen::Matrix3d rotation = pose.linear();
  return (rotation * rotation.transpose()).isApprox(Eigen::Matrix3d::Identity(), kTolerance) &&
         rotation.determinant() > 0;
}

/// Everything a system says is checked before it is used.
std::string Fault(const FrameEstimate& estimate, const StereoFrame& frame) {
  if (estimate.id != frame.id || estimate.stamp_ns != frame.stamp_ns) {
    return fmt::format("frame {}: the answer belongs to frame {}", frame.id, estimate.id);
  }
  if (estimate.T_world_rig && !IsRigid(*estimate.T_world_rig)) {
    return fmt::format("frame {}: the pose is no finite rigid motion", frame.id);
  }
  if (!estimate.regions.mask.empty() && estimate.regions.mask.size() != frame.left.size()) {
    return fmt::format("frame {}: the mask has another size than the image", frame.id);
  }
  return {};
}

bool IsSet(const cv::Mat1b& mask, const cv::Point2f& at) {
  const cv::Point pixel(cvRound(at.x), cvRound(at.y));
  return cv::Rect(0, 0, mask.cols, mask.rows).contains(pixel) && mask(pixel) != 0;
}

double Share(const cv::Mat1b& mask) {
  return mask.empty() ? 0 : cv::countNonZero(mask) / static_cast<double>(mask.total());
}

void CountFeatures(const FrameEstimate& estimate, const cv::Mat1b& dynamic, FrameFacts* facts) {
  facts->features = static_cast<int>(estimate.keypoints.size());
  for (std::size_t i = 0; i < estimate.keypoints.size(); ++i) {
    if (!IsSet(dynamic, estimate.keypoints[i])) continue;
    ++facts->features_on_movers;
    const bool used = i < estimate.keypoint_is_inlier.size() && estimate.keypoint_is_inlier[i];
    facts->inliers_on_movers += used ? 1 : 0;
  }
}

FrameFacts FactsOf(const SequenceFrame& shown, const FrameEstimate& estimate) {
  FrameFacts facts;
  facts.stamp_ns = shown.images.stamp_ns;
  if (!shown.truth) return facts;
  const FrameTruth& truth = *shown.truth;
  facts.T_world_rig = truth.T_world_rig;
  facts.movers_share = Share(truth.dynamic);
  facts.actors_share = Share(truth.actor);
  CountFeatures(estimate, truth.dynamic, &facts);
  if (!truth.dynamic.empty()) {
    facts.mask = CompareMasks(shown.images.left, truth, estimate.regions);
  }
  return facts;
}

/// A mask handed over is the system's mask, unless it says otherwise.
void AdoptMask(const ExternalMask& mask, FrameEstimate* estimate) {
  if (estimate->regions.mask.empty() && estimate->regions.regions.empty()) {
    estimate->regions.mask = mask.left;
  }
}

Trajectory LiveTrack(const std::vector<FrameEstimate>& estimates) {
  Trajectory live;
  for (const FrameEstimate& estimate : estimates) {
    if (estimate.T_world_rig) live.push_back({estimate.stamp_ns, *estimate.T_world_rig});
  }
  return live;
}

std::string FaultOfTrack(const Trajectory& track) {
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (!IsRigid(track[i].T_world_rig)) {
      return fmt::format("final track, pose {}: no finite rigid motion", i);
    }
    if (i > 0 && track[i].stamp_ns <= track[i - 1].stamp_ns) {
      return fmt::format("final track, pose {}: stamps do not rise", i);
    }
  }
  return {};
}

double PeakRssMib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

bool Rejects(const FrameEstimate& estimate) {
  return !estimate.regions.mask.empty() || !estimate.regions.regions.empty();
}

/// A system that never rejects anything makes no masks, rather than bad ones. One that does is
/// asked for them in every frame: silence where something moves is a miss.
void DropMaskFacts(std::vector<FrameFacts>* facts) {
  for (FrameFacts& frame : *facts) frame.mask.reset();
}

/// Heavy images are not kept: a run of a thousand frames must fit beside others.
void DropImages(FrameEstimate* estimate) {
  estimate->regions.mask.release();
  estimate->keypoints = {};
  estimate->keypoint_is_inlier = {};
  estimate->draw_stages = {};
}

Offence Judge(const RunResult& result, std::size_t frames, double min_coverage) {
  const auto tracked = static_cast<double>(result.trajectory.live.size());
  if (tracked >= min_coverage * static_cast<double>(frames)) return {};
  return {RunStatus::kLost,
          fmt::format("a pose for {} of {} frames only", result.trajectory.live.size(), frames)};
}

}  // namespace

RunResult Drive(const Sequence& sequence, Estimator& estimator, const MaskMaker& masks,
                const DriveOptions& options, const FrameObserver& observer) {
  const Stopwatch whole;
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  FramesAhead frames(sequence, schedule, options.frames_ahead);
  RunResult result;
  Offence offence;
  bool ever_rejected = false;
  const StereoCalibration calibration = sequence.calibration();
  const double frame_ms = 1000 / sequence.rate_hz();
  std::optional<Eigen::Isometry3d> T_world_previous;
  for (std::size_t i = 0; i < schedule.size() && offence.why.empty(); ++i) {
    const FramesAhead::Frame next = frames.Next();
    const SequenceFrame& shown = next.frame;
    const ExternalMask mask = masks(shown);
    const Stopwatch step;
    FrameEstimate estimate;
    try {
      estimate = estimator.Process(shown.images, mask);
    } catch (const std::exception& error) {
      offence = {RunStatus::kCrashed, fmt::format("frame {}: {}", shown.images.id, error.what())};
      break;
    }
    const double process_ms = step.ElapsedMs();
    offence = Offends(RunStatus::kInvalid, Fault(estimate, shown.images));
    if (!offence.why.empty()) break;

    AdoptMask(mask, &estimate);
    ever_rejected = ever_rejected || Rejects(estimate);
    FrameFacts facts = FactsOf(shown, estimate);
    if (shown.truth) {
      facts.difficulty =
          DifficultyOf(shown.images.left, *shown.truth, calibration, T_world_previous, frame_ms);
      T_world_previous = shown.truth->T_world_rig;
    }
    facts.render_ms = next.made_ms;
    facts.process_ms = process_ms;
    if (observer) observer({schedule[i], shown, estimate, facts, i, schedule.size()});

    DropImages(&estimate);
    if (shown.truth) result.truth.push_back({facts.stamp_ns, facts.T_world_rig});
    result.facts.push_back(std::move(facts));
    result.estimates.push_back(std::move(estimate));
  }
  if (!ever_rejected) DropMaskFacts(&result.facts);
  result.trajectory.live = LiveTrack(result.estimates);
  if (offence.why.empty()) {
    try {
      result.trajectory.final = estimator.Finish();
      offence = Offends(RunStatus::kInvalid, FaultOfTrack(result.trajectory.final));
    } catch (const std::exception& error) {
      offence = {RunStatus::kCrashed, fmt::format("at the end: {}", error.what())};
    }
  }
  if (offence.why.empty()) offence = Judge(result, schedule.size(), options.min_coverage);
  result.status = offence.status;
  result.status_why = offence.why;
  result.wall_s = whole.ElapsedMs() * 1e-3;
  result.peak_rss_mib = PeakRssMib();
  return result;
}

}  // namespace aisle
