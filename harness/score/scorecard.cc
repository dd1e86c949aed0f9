#include "harness/score/scorecard.h"

#include "harness/score/segments.h"

namespace aisle {
namespace {

Score Absent(const std::string& unit, const std::string& why) {
  return {.value = std::nullopt, .unit = unit, .alignment = "", .n = 0, .absent = why};
}

Score Present(double value, const std::string& unit, std::size_t n,
              const std::string& alignment = "") {
  return {.value = value, .unit = unit, .alignment = alignment, .n = n, .absent = ""};
}

void AddStatistics(const std::string& prefix, const std::string& unit,
                   const std::vector<double>& errors, const std::string& alignment,
                   Scorecard* scores) {
  const Statistics s = Summarize(errors);
  const std::pair<const char*, double> named[] = {{"rmse", s.rmse},     {"mean", s.mean},
                                                  {"median", s.median}, {"std", s.std},
                                                  {"min", s.min},       {"max", s.max}};
  for (const auto& [name, value] : named) {
    (*scores)[prefix + "_" + name + "_" + unit] = Present(value, unit, s.n, alignment);
  }
}

void AddSegments(const std::string& suffix, const TrajectoryScore& track, const Trajectory& truth,
                 const Trajectory& estimate, const SegmentOptions& options, Scorecard* scores) {
  const SegmentScore mean = PooledMean(SegmentErrors(truth, estimate, track.pairs, options));
  Score& t = (*scores)["t_rel" + suffix + "_percent"];
  Score& r = (*scores)["r_rel" + suffix + "_deg_per_100m"];
  if (mean.segments == 0) {
    const std::string why =
        fmt::format("no stretch of the path is longer than {:g} m", options.lengths_m.front());
    t = Absent("%", why);
    r = Absent("deg/100m", why);
    return;
  }
  t = Present(mean.translation_percent, "%", mean.segments, "none");
  r = Present(mean.rotation_deg_per_100m, "deg/100m", mean.segments, "none");
}

void AddRelative(const TrajectoryScore& track, const Trajectory& truth, const Trajectory& estimate,
                 const std::string& prefix, const RelativeOptions& options, Scorecard* scores) {
  const auto errors = RelativeErrors(truth, estimate, track.pairs,
                                     SelectSpans(truth, estimate, track.pairs, options));
  if (errors.empty()) {
    (*scores)[prefix + "_trans_rmse_m"] = Absent("m", "no two poses lie " + Describe(options));
    return;
  }
  AddStatistics(prefix + "_trans", "m", Translations(errors), "none", scores);
  (*scores)[prefix + "_rot_rmse_deg"] =
      Present(Summarize(Rotations(errors)).rmse, "deg", errors.size(), "none");
}

// --- One run
// --------------------------------------------------------------------------------------

/// Error of the live track at every frame of the truth; infinite where it has no pose.
std::vector<double> ErrorsOverAllFrames(const RunResult& run, const TrajectoryScore& live) {
  std::vector<double> errors(run.truth.size(), std::numeric_limits<double>::infinity());
  for (const PoseError& error : live.errors) errors[error.pair.truth] = error.translation_m;
  return errors;
}

Score QuantileScore(const std::vector<double>& errors, double q, const std::string& alignment) {
  const double value = errors.empty() ? 0 : Quantile(errors, q);
  if (errors.empty()) return Absent("m", "no frames");
  if (!std::isfinite(value)) {
    return Absent("m", fmt::format("lost in more than {:g} % of the frames", 100 * (1 - q)));
  }
  return Present(value, "m", errors.size(), alignment);
}

void AddLiveTrack(const RunResult& run, const ScoreOptions& options, Scorecard* scores) {
  const TrajectoryScore live = ScoreTrajectory(run.truth, run.trajectory.live, options);
  const auto rmse = live.scores.find("ate_rmse_m");
  (*scores)["ate_live_rmse_m"] = rmse->second;
  const std::vector<double> errors = ErrorsOverAllFrames(run, live);
  const std::string alignment = Name(options.alignment.method);
  (*scores)["error_all_p50_m"] = QuantileScore(errors, 0.50, alignment);
  (*scores)["error_all_p95_m"] = QuantileScore(errors, 0.95, alignment);
}

void AddCoverage(const RunResult& run, Scorecard* scores) {
  std::size_t tracked = 0, lost_times = 0;
  double longest_gap_s = 0;
  bool lost = false;
  std::int64_t lost_since_ns = 0;
  for (const FrameEstimate& estimate : run.estimates) {
    if (estimate.T_world_rig) {
      ++tracked;
      const double gap_s = static_cast<double>(estimate.stamp_ns - lost_since_ns) * 1e-9;
      if (lost) longest_gap_s = std::max(longest_gap_s, gap_s);
      lost = false;
    } else if (tracked > 0 && !lost) {
      lost = true;
      lost_since_ns = estimate.stamp_ns;
      ++lost_times;
    }
  }
  const std::size_t frames = run.facts.size();
  (*scores)["coverage"] =
      frames > 0 ? Present(static_cast<double>(tracked) / static_cast<double>(frames), "1", frames)
                 : Absent("1", "no frames");
  (*scores)["times_lost"] = Present(static_cast<double>(lost_times), "1", frames);
  if (lost) {
    (*scores)["recovery_max_s"] = Absent("s", "did not recover before the end");
  } else if (lost_times > 0) {
    (*scores)["recovery_max_s"] = Present(longest_gap_s, "s", lost_times);
  } else {
    (*scores)["recovery_max_s"] = Absent("s", "never lost");
  }
}

Score RatioScore(double part, double whole, const std::string& nothing) {
  if (whole <= 0) return Absent("1", nothing);
  return Present(part / whole, "1", static_cast<std::size_t>(whole));
}

void AddMasks(const RunResult& run, Scorecard* scores) {
  MaskFacts sum;
  bool any = false;
  for (const FrameFacts& frame : run.facts) {
    if (!frame.mask) continue;
    any = true;
    sum.true_positives += frame.mask->true_positives;
    sum.false_positives += frame.mask->false_positives;
    sum.false_negatives += frame.mask->false_negatives;
    sum.objects_found += frame.mask->objects_found;
    sum.objects_invented += frame.mask->objects_invented;
    sum.objects_missed += frame.mask->objects_missed;
    sum.iou_sum += frame.mask->iou_sum;
    sum.static_corners += frame.mask->static_corners;
    sum.static_corners_lost += frame.mask->static_corners_lost;
  }
  if (!any) return;  // the system makes no masks: no row is clearer than nine empty ones
  const auto tp = static_cast<double>(sum.true_positives);
  const auto fp = static_cast<double>(sum.false_positives);
  const auto fn = static_cast<double>(sum.false_negatives);
  (*scores)["mask_precision"] = RatioScore(tp, tp + fp, "nothing was rejected");
  (*scores)["mask_recall"] = RatioScore(tp, tp + fn, "nothing moved");
  (*scores)["mask_iou"] = RatioScore(tp, tp + fp + fn, "nothing moved, nothing was rejected");
  const double found = sum.objects_found;
  (*scores)["object_precision"] =
      RatioScore(found, found + sum.objects_invented, "nothing was rejected");
  (*scores)["object_recall"] = RatioScore(found, found + sum.objects_missed, "nothing moved");
  (*scores)["object_iou"] = RatioScore(sum.iou_sum, found, "no object was found");
  (*scores)["static_features_lost"] =
      RatioScore(sum.static_corners_lost, sum.static_corners, "no corner on a static surface");
}

void AddFeatures(const RunResult& run, Scorecard* scores) {
  double features = 0, on_movers = 0, inliers_on_movers = 0;
  for (const FrameFacts& frame : run.facts) {
    features += frame.features;
    on_movers += frame.features_on_movers;
    inliers_on_movers += frame.inliers_on_movers;
  }
  (*scores)["features_on_movers"] = RatioScore(on_movers, features, "the system shows no features");
  (*scores)["inliers_on_movers_per_frame"] =
      run.facts.empty() ? Absent("1", "no frames")
                        : Present(inliers_on_movers / static_cast<double>(run.facts.size()), "1",
                                  run.facts.size());
}

void AddTimes(const RunResult& run, Scorecard* scores) {
  std::map<std::string, std::vector<double>> stages;
  for (const FrameEstimate& estimate : run.estimates) {
    for (const auto& [stage, ms] : estimate.stage_ms) stages[stage].push_back(ms);
  }
  for (const FrameFacts& frame : run.facts) {
    stages["render"].push_back(frame.render_ms);
    stages["process"].push_back(frame.process_ms);
  }
  for (const auto& [stage, ms] : stages) {
    (*scores)["ms_" + stage + "_mean"] = Present(Summarize(ms).mean, "ms", ms.size());
  }
  if (run.peak_rss_mib > 0) (*scores)["peak_rss_mib"] = Present(run.peak_rss_mib, "MiB", 1);
}

}  // namespace

TrajectoryScore ScoreTrajectory(const Trajectory& truth, const Trajectory& estimate,
                                const ScoreOptions& options) {
  TrajectoryScore result;
  const std::int64_t bound_ns = MaxDifferenceNs(truth, estimate, options.association);
  result.association = Describe(options.association.rule, bound_ns);
  result.pairs = Associate(truth, estimate, options.association);
  if (result.pairs.empty()) {
    const std::string why =
        estimate.empty()
            ? "the estimate holds no poses"
            : "no stamp of the estimate is near one of the truth (" + result.association + ")";
    result.notes.push_back(why);
    for (const char* name : {"ate_rmse_m", "rpe_trans_rmse_m"}) {
      result.scores[name] = Absent("m", why);
    }
    return result;
  }
  const std::string alignment = Name(options.alignment.method);
  result.alignment = Align(truth, estimate, result.pairs, options.alignment);
  result.errors = AbsoluteErrors(truth, estimate, result.pairs, result.alignment);
  AddStatistics("ate", "m", Translations(result.errors), alignment, &result.scores);
  result.scores["ate_rot_rmse_deg"] =
      result.alignment.rotation_determined
          ? Present(Summarize(Rotations(result.errors)).rmse, "deg", result.errors.size(),
                    alignment)
          : Absent("deg", "the path is a straight line: alignment leaves a turn about it free");
  AddRelative(result, truth, estimate, "rpe", options.relative, &result.scores);
  AddRelative(result, truth, estimate, "rpe_1s",
              {.delta = 1, .unit = DeltaUnit::kSeconds, .all_pairs = true}, &result.scores);
  AddSegments("", result, truth, estimate, SegmentOptions{}, &result.scores);
  AddSegments("_short", result, truth, estimate, ShortSegments(), &result.scores);
  const std::string mismatch = FrameMismatch(truth, estimate, result.errors, result.alignment);
  if (!mismatch.empty()) result.notes.push_back(mismatch);
  return result;
}

Scorecard ScoreRun(const RunResult& run, const ScoreOptions& options) {
  Scorecard scores = ScoreTrajectory(run.truth, run.trajectory.final, options).scores;
  AddLiveTrack(run, options, &scores);
  AddCoverage(run, &scores);
  AddMasks(run, &scores);
  AddFeatures(run, &scores);
  AddTimes(run, &scores);
  return scores;
}

Scorecard ScoreMasks(const RunResult& run) {
  Scorecard scores;
  AddMasks(run, &scores);
  return scores;
}

std::string ToText(const Score& score) {
  if (!score.value) return "- (" + score.absent + ")";
  return fmt::format("{:.6g} {} (n = {}{})", *score.value, score.unit == "1" ? "" : score.unit,
                     score.n, score.alignment.empty() ? "" : ", alignment " + score.alignment);
}

}  // namespace aisle
