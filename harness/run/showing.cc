#include "harness/run/showing.h"

#include <sys/resource.h>

#include <algorithm>
#include <new>

#include "harness/contract/map_id.h"
#include "harness/contract/rigid.h"
#include "harness/contract/system_fault.h"
#include "harness/score/difficulty.h"
#include "harness/score/masks.h"

namespace aisle {
namespace {

constexpr double kRigidToScore = 1e-3;

/// Everything a system says is checked before it is used.
std::string Fault(const FrameEstimate& estimate, const StereoFrame& frame) {
  if (estimate.id != frame.id || estimate.stamp_ns != frame.stamp_ns) {
    return fmt::format("frame {}: the answer belongs to frame {}", frame.id, estimate.id);
  }
  if (estimate.T_world_rig && !IsRigid(*estimate.T_world_rig, kRigidToScore)) {
    return fmt::format("frame {}: the pose is not a rigid motion within {:g} m", frame.id,
                       kFarthest_m);
  }
  if (!estimate.regions.mask.empty() && estimate.regions.mask.size() != frame.left.size()) {
    return fmt::format("frame {}: the mask and the image differ in size", frame.id);
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

/// The poses of the last world that the system has begun, as known at their frames.
Trajectory LiveTrack(const std::vector<FrameEstimate>& estimates) {
  Trajectory live;
  const int last = estimates.empty() ? 0 : MapIdOf(estimates.back());
  for (const FrameEstimate& estimate : estimates) {
    if (MapIdOf(estimate) != last || !estimate.T_world_rig) continue;
    live.push_back({estimate.stamp_ns, *estimate.T_world_rig});
  }
  return live;
}

/// Where poses were handed out in worlds that were given up later, a sentence about it.
std::optional<std::string> NoteOfFormerWorlds(const std::vector<FrameEstimate>& estimates) {
  if (estimates.empty() || MapIdOf(estimates.back()) == MapIdOf(estimates.front())) return {};
  const int last = MapIdOf(estimates.back());
  const auto begun = std::ranges::find(estimates, last, MapIdOf);
  const auto lost = std::count_if(estimates.begin(), begun, [](const FrameEstimate& estimate) {
    return estimate.T_world_rig.has_value();
  });
  return fmt::format(
      "it gave up its map and began another, last at frame {}: the {} live poses before that are "
      "of another world and count as missing",
      begun->id, lost);
}

/// Poses of a track that are of no frame that was shown: a clock of another unit or beginning, say.
/// Scores would pass over them and speak of the rest alone.
std::size_t CountForeign(const Trajectory& track, const std::vector<FrameEstimate>& shown) {
  return static_cast<std::size_t>(std::ranges::count_if(track, [&](const StampedPose& pose) {
    return !std::ranges::binary_search(shown, pose.stamp_ns, {}, &FrameEstimate::stamp_ns);
  }));
}

/// `shown`: what it said of every frame, stamps rising.
std::string FaultOfTrack(const Trajectory& track, const std::vector<FrameEstimate>& shown) {
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (!IsRigid(track[i].T_world_rig, kRigidToScore)) {
      return fmt::format("final track, pose {}: not a rigid motion within {:g} m", i, kFarthest_m);
    }
    if (i > 0 && track[i].stamp_ns <= track[i - 1].stamp_ns) {
      return fmt::format("final track, pose {}: timestamps do not increase", i);
    }
  }
  if (const std::size_t foreign = CountForeign(track, shown); foreign > 0) {
    return fmt::format(
        "final track: {} of {} poses have a timestamp that belongs to no frame: expected the "
        "frames' own, in nanoseconds",
        foreign, track.size());
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

/// Why the run counts as lost, or an empty string.
std::string TooFewPoses(const RunResult& result, std::size_t frames, double min_coverage) {
  const auto tracked = static_cast<double>(result.trajectory.live.size());
  if (tracked >= min_coverage * static_cast<double>(frames)) return {};
  return fmt::format("poses for only {} of {} frames", result.trajectory.live.size(), frames);
}

}  // namespace

Showing::Showing(const StereoCalibration& calibration, double rate_hz, Estimator& estimator,
                 const MaskMaker& masks, const FrameObserver& observer)
    : calibration_(calibration),
      frame_ms_(1000 / rate_hz),
      estimator_(estimator),
      masks_(masks),
      observer_(observer) {}

/// An empty reason is no offence; the first one counts.
void Showing::Offend(RunStatus status, const std::string& why) {
  if (why.empty() || offended()) return;
  status_ = status;
  why_ = why;
}

const FrameEstimate* Showing::Show(const FrameRequest& request, const SequenceFrame& shown,
                                   double made_ms, std::size_t index, std::size_t count) {
  const ExternalMask mask = masks_(shown);
  const Stopwatch step;
  FrameEstimate estimate;
  try {
    estimate = estimator_.Process(shown.images, mask);
  } catch (const SystemFault& fault) {
    Offend(fault.status, fmt::format("frame {}: {}", shown.images.id, fault.what()));
    return nullptr;
  } catch (const std::bad_alloc&) {
    throw;  // the machine's, of which the system shall not be accused
  } catch (const std::exception& error) {
    Offend(RunStatus::kCrashed, fmt::format("frame {}: {}", shown.images.id, error.what()));
    return nullptr;
  }
  const double process_ms = step.ElapsedMs();
  Offend(RunStatus::kInvalid, Fault(estimate, shown.images));
  const int map_id = MapIdOf(estimate),
            map_id_before = result_.estimates.empty() ? map_id : MapIdOf(result_.estimates.back());
  if (map_id < map_id_before) {
    Offend(RunStatus::kInvalid, fmt::format("frame {}: its map_id falls from {} to {}",
                                            shown.images.id, map_id_before, map_id));
  }
  if (offended()) return nullptr;

  AdoptMask(mask, &estimate);
  ever_rejected_ = ever_rejected_ || Rejects(estimate);
  FrameFacts facts = FactsOf(shown, estimate);
  if (shown.truth) {
    facts.difficulty =
        DifficultyOf(shown.images.left, *shown.truth, calibration_, T_world_previous_, frame_ms_);
    T_world_previous_ = shown.truth->T_world_rig;
  }
  facts.render_ms = made_ms;
  facts.process_ms = process_ms;
  if (observer_) observer_({request, shown, estimate, facts, index, count});

  DropImages(&estimate);
  if (shown.truth) result_.truth.push_back({facts.stamp_ns, facts.T_world_rig});
  result_.facts.push_back(std::move(facts));
  result_.estimates.push_back(std::move(estimate));
  return &result_.estimates.back();
}

RunResult Showing::Finish(std::size_t frames, double min_coverage) {
  if (!ever_rejected_) DropMaskFacts(&result_.facts);
  result_.trajectory.live = LiveTrack(result_.estimates);
  if (auto note = NoteOfFormerWorlds(result_.estimates)) result_.notes.push_back(*std::move(note));
  if (!offended()) {
    try {
      Trajectory track = estimator_.Finish();
      Offend(RunStatus::kInvalid, FaultOfTrack(track, result_.estimates));
      if (!offended()) result_.trajectory.final = std::move(track);
    } catch (const SystemFault& fault) {
      Offend(fault.status, fmt::format("at the end: {}", fault.what()));
    } catch (const std::bad_alloc&) {
      throw;  // the machine's, of which the system shall not be accused
    } catch (const std::exception& error) {
      Offend(RunStatus::kCrashed, fmt::format("at the end: {}", error.what()));
    }
  }
  Offend(RunStatus::kLost, TooFewPoses(result_, frames, min_coverage));
  result_.status = status_;
  result_.status_why = why_;
  result_.wall_s = whole_.ElapsedMs() * 1e-3;
  result_.peak_rss_mib = PeakRssMib();
  return std::move(result_);
}

}  // namespace aisle
