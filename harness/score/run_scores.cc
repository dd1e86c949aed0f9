#include "harness/contract/stream.h"
#include "harness/score/coverage.h"
#include "harness/score/front_end.h"
#include "harness/score/mask_scores.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

void AddLiveTrack(const RunResult& run, const TrajectoryScore& live, const ScoreOptions& options,
                  Scorecard* scores) {
  (*scores)["ate_live_rmse_m"] = live.scores.at("ate_rmse_m");
  AddCoverage(ErrorsOverFrames(run.truth, live), Name(options.alignment.method), scores);
}

void AddDifficulty(const RunResult& run, Scorecard* scores) {
  std::vector<double> movers, texture, flow, blur, parallax;
  for (const FrameFacts& frame : run.facts) {
    movers.push_back(frame.movers_share);
    const Difficulty& d = frame.difficulty;
    if (d.static_texture_share) texture.push_back(*d.static_texture_share);
    if (d.flow_px) flow.push_back(*d.flow_px);
    if (d.blur_px) blur.push_back(*d.blur_px);
    if (d.parallax_px) parallax.push_back(*d.parallax_px);
  }
  const auto add = [&](const char* name, const char* unit, const std::vector<double>& values) {
    if (!values.empty()) {
      (*scores)[name] = Present(Summarize(values).mean, unit, values.size());
    }
  };
  add("difficulty_movers_share", "1", movers);
  add("difficulty_static_texture_share", "1", texture);
  add("difficulty_flow_px", "px", flow);
  add("difficulty_blur_px", "px", blur);
  add("difficulty_parallax_px", "px", parallax);
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
      : features == 0   ? Absent("1", "the system shows no features")
                        : Present(inliers_on_movers / static_cast<double>(run.facts.size()), "1",
                                  run.facts.size());
}

/// Nobody saw the steps of a foreign system: what is not known of them is not 0 ms.
void KeepKnownTimes(const RunResult& run, std::map<std::string, std::vector<double>>* stages) {
  const bool ended = run.status != RunStatus::kCrashed && run.status != RunStatus::kTimeout;
  if (!ended || run.wall_s <= 0) stages->erase("process");
  const std::vector<double>& render_ms = (*stages)["render"];
  const bool shown =
      std::any_of(render_ms.begin(), render_ms.end(), [](double ms) { return ms > 0; });
  if (!shown) stages->erase("render");
}

void AddTimes(const RunResult& run, Scorecard* scores) {
  std::map<std::string, std::vector<double>> stages;
  for (const FrameEstimate& estimate : run.estimates) {
    for (const auto& [stage, ms] : estimate.stage_ms) stages[stage].push_back(ms);
    const auto front_end = FrontEndOf(estimate.stage_ms);
    if (!front_end) continue;
    stages["tracking"].push_back(front_end->tracking);
    stages["front_end"].push_back(front_end->total());
  }
  for (const FrameFacts& frame : run.facts) {
    stages["render"].push_back(frame.render_ms);
    stages["process"].push_back(frame.process_ms);
  }
  if (run.spec.system.external) KeepKnownTimes(run, &stages);
  for (const auto& [stage, ms] : stages) {
    (*scores)["ms_" + stage + "_mean"] = Present(Summarize(ms).mean, "ms", ms.size());
  }
  const auto& external = run.spec.system.external;
  if (external && !IsStream(*external) && scores->contains("ms_process_mean")) {
    (*scores)["ms_process_mean"].basis = "wall time of the whole process over its frames";
  }
  if (run.peak_rss_mib > 0) (*scores)["peak_rss_mib"] = Present(run.peak_rss_mib, "MiB", 1);
}

}  // namespace

RunScore ScoreRun(const RunResult& run, const ScoreOptions& options) {
  RunScore score;
  score.live = ScoreTrajectory(run.truth, run.trajectory.live, options);
  score.final = ScoreTrajectory(run.truth, run.trajectory.final, options);
  score.scores = score.final.scores;
  AddLiveTrack(run, score.live, options, &score.scores);
  AddMasks(run.facts, &score.scores);
  AddFeatures(run, &score.scores);
  AddDifficulty(run, &score.scores);
  AddTimes(run, &score.scores);
  return score;
}

Scorecard ScoreMasks(const RunResult& run) {
  Scorecard scores;
  AddMasks(run.facts, &scores);
  return scores;
}

}  // namespace aisle
