#include "harness/score/scorecard.h"

#include "harness/score/conventions.h"
#include "harness/score/segments.h"
#include "harness/score/stamp_unit.h"

namespace aisle {
namespace {

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

void AddAbsolute(const TrajectoryScore& track, const AlignmentOptions& options, Scorecard* scores) {
  const std::string alignment = Name(options.method);
  if (!track.alignment.leaves_errors) {
    const std::string why = fmt::format(
        "alignment by {} leaves an error of {} pairs or more; here it had {}", alignment,
        FewestPairs(options.method),
        options.first_n > 0 ? std::min(options.first_n, track.pairs.size()) : track.pairs.size());
    (*scores)["ate_rmse_m"] = Absent("m", why);
    (*scores)["ate_rot_rmse_deg"] = Absent("deg", why);
    return;
  }
  AddStatistics("ate", "m", Translations(track.errors), alignment, scores);
  (*scores)["ate_rot_rmse_deg"] =
      track.alignment.rotation_determined
          ? Present(Summarize(Rotations(track.errors)).rmse, "deg", track.errors.size(), alignment)
          : Absent("deg", "the path is a straight line: alignment leaves a turn about it free");
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

}  // namespace

TrajectoryScore ScoreTrajectory(const Trajectory& truth, const Trajectory& estimate,
                                const ScoreOptions& options) {
  TrajectoryScore result;
  const std::int64_t bound_ns = MaxDifferenceNs(truth, estimate, options.association);
  result.association = Describe(options.association.rule, bound_ns);
  result.pairs = Associate(truth, estimate, options.association);
  if (options.association.rule != AssociationRule::kIndex) {
    result.stamp_factor = StampFactor(truth, estimate, result.pairs);
  }
  if (result.stamp_factor) result.notes.push_back(NoteOnStamps(*result.stamp_factor));
  if (result.pairs.empty()) {
    const std::string why =
        estimate.empty()
            ? "no frame has a pose"
            : "no stamp of the estimate is near one of the truth (" + result.association + ")";
    result.notes.insert(result.notes.begin(), why);
    for (const char* name : {"ate_rmse_m", "rpe_trans_rmse_m"}) {
      result.scores[name] = Absent("m", why);
    }
    return result;
  }
  result.alignment = Align(truth, estimate, result.pairs, options.alignment);
  if (result.alignment.leaves_errors) {
    result.errors = AbsoluteErrors(truth, estimate, result.pairs, result.alignment);
  }
  AddAbsolute(result, options.alignment, &result.scores);
  AddRelative(result, truth, estimate, "rpe", options.relative, &result.scores);
  AddRelative(result, truth, estimate, "rpe_1m",
              {.delta = 1, .unit = DeltaUnit::kMetres, .all_pairs = true}, &result.scores);
  AddRelative(result, truth, estimate, "rpe_1s",
              {.delta = 1, .unit = DeltaUnit::kSeconds, .all_pairs = true}, &result.scores);
  AddSegments("", result, truth, estimate, SegmentOptions{}, &result.scores);
  AddSegments("_short", result, truth, estimate, ShortSegments(), &result.scores);
  const auto conventions =
      NotesOnConventions(truth, estimate, result.pairs, options.alignment.method);
  result.notes.insert(result.notes.end(), conventions.begin(), conventions.end());
  const std::string mismatch = FrameMismatch(truth, estimate, result.errors, result.alignment);
  if (!mismatch.empty()) result.notes.push_back(mismatch);
  return result;
}

Score Absent(const std::string& unit, const std::string& why) {
  return {.value = std::nullopt, .unit = unit, .alignment = "", .n = 0, .absent = why};
}

Score Present(double value, const std::string& unit, std::size_t n, const std::string& alignment) {
  return {.value = value, .unit = unit, .alignment = alignment, .n = n, .absent = ""};
}

Score RatioScore(double part, double whole, const std::string& nothing) {
  if (whole <= 0) return Absent("1", nothing);
  return Present(part / whole, "1", static_cast<std::size_t>(whole));
}

std::string ToText(const Score& score) {
  if (!score.value) return "- (" + score.absent + ")";
  return fmt::format("{:.6g} {} (n = {}{})", *score.value, score.unit == "1" ? "" : score.unit,
                     score.n, score.alignment.empty() ? "" : ", alignment " + score.alignment);
}

}  // namespace aisle
