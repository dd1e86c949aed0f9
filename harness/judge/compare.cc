#include "harness/judge/compare.h"

#include "harness/judge/breaks.h"
#include "harness/judge/cell.h"
#include "harness/record/seed_values.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

/// Which way a score is good, and whether it may raise an alarm.
struct Judged {
  const char* score;
  bool more_is_better;
  double smallest_effect =
      0;  ///< in the score's unit, where a share of the old median is too coarse
};
/// Each one more costs all of them power: with nine seeds a side no p is below 4.1e-5, so that an
/// alpha of 0.01 has room for 231 comparisons that are not equal to the last bit.
constexpr Judged kJudged[] = {{"coverage", true, 0.01},
                              {"ate_rmse_m", false},
                              {"ate_live_rmse_m", false},
                              {"error_all_p95_m", false},
                              {"rpe_1s_trans_rmse_m", false},
                              {"rpe_1s_rot_rmse_deg", false},
                              {"features_on_movers", false},
                              {"object_precision", true},
                              {"object_recall", true},
                              {"mask_iou", true},
                              {"static_features_lost", false},
                              {"mover_large_found_within_1s", true},
                              {"mover_large_gap_max_frames", false, 1},
                              // Of closed drives, which alone have them; whole numbers and lengths
                              // that are near zero when all is well.
                              {"goal_reached", true, 0.01},
                              {"collisions", false, 0.05},
                              {"cross_track_max_m", false, 0.002},
                              {"docking_error_m", false, 0.001},
                              {"docking_error_deg", false, 0.02},
                              {"min_clearance_static_m", true, 0.01},
                              {"min_clearance_person_m", true, 0.02},
                              {"lost_s", false, 0.05}};
/// The share of alpha that seeds that break may use up: medians, whose p has a floor, need the
/// rest.
constexpr double kAlphaOfBreaks = 0.05;

constexpr const char* kWatched[] = {"ms_process_mean", "ms_render_mean", "peak_rss_mib"};

std::map<CellOfNight, std::vector<const RunRecord*>> Cells(const Results& results) {
  std::map<CellOfNight, std::vector<const RunRecord*>> cells;
  for (const RunRecord& run : results.runs) cells[CellOf(run.spec)].push_back(&run);
  return cells;
}

bool SameSeeds(const ValuesBySeed& a, const ValuesBySeed& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [](const auto& x, const auto& y) { return x.first == y.first; });
}

/// Where enough seeds stand on both sides, those alone: a seed is compared with its own past, and
/// one that a side lacks would move that side's median by itself. How many are left out.
std::size_t KeepShared(ValuesBySeed* before, ValuesBySeed* after) {
  ValuesBySeed old_shared, new_shared;
  for (const auto& [seed, value] : *before) {
    const auto at = after->find(seed);
    if (at == after->end()) continue;
    old_shared[seed] = value;
    new_shared[seed] = at->second;
  }
  if (old_shared.size() < kFewestSeeds) return 0;
  const std::size_t left_out = before->size() + after->size() - 2 * old_shared.size();
  *before = std::move(old_shared);
  *after = std::move(new_shared);
  return left_out;
}

/// New minus old: by seed where the seeds are the same, every new against the old median else.
std::vector<double> Differences(const ValuesBySeed& before, const ValuesBySeed& after,
                                bool paired) {
  const double old_median = Quantile(Plain(before), 0.5);
  std::vector<double> differences;
  for (const auto& [seed, value] : after) {
    differences.push_back(value - (paired ? before.at(seed) : old_median));
  }
  return differences;
}

const Judged* FindJudged(const std::string& score) {
  for (const Judged& judged : kJudged) {
    if (score == judged.score) return &judged;
  }
  return nullptr;
}

/// "seed 3: nothing was rejected": the first that had a value, ran again and has none.
std::string FirstGone(const ValuesBySeed& before, const ValuesBySeed& now,
                      const std::vector<const RunRecord*>& after, const std::string& score) {
  for (const RunRecord* run : after) {
    const std::uint64_t seed = run->spec.seed;
    if (!before.contains(seed) || now.contains(seed)) continue;
    const auto at = run->scores.find(score);
    const bool said = at != run->scores.end() && !at->second.absent.empty();
    const std::string why = said                       ? at->second.absent
                            : !run->status_why.empty() ? run->status_why
                                                       : "the run has no such score";
    return fmt::format("seed {}: {}", seed, why);
  }
  return "";
}

/// By how much a value must change at least to be far from another, in the score's unit.
double FarStep(const Judged& judged, const std::string& unit) {
  constexpr double kFarShare = 0.2;
  if (judged.smallest_effect > 0) return 10 * judged.smallest_effect;
  return unit == "1" ? kFarShare : 0;
}

bool IsFarWorse(const Judged& judged, double step, double before, double after) {
  constexpr double kFarTimes = 3;
  if (judged.more_is_better) return before - after > step;
  return after > kFarTimes * before && after - before > step;
}

/// How bad a value is, on a scale on which scatter is a factor: errors and what a share lacks grow
/// as their logarithms, but for differences that are nobody's trouble; clearances shrink likewise.
double Badness(const Judged& judged, const std::string& unit, double value) {
  constexpr double kTiny = 1e-12;
  const double least = std::max(kTiny, FarStep(judged, unit) / 10);
  if (!judged.more_is_better) return std::log(std::max(value, 0.0) + least);
  if (unit == "1") return std::log(std::max(1 - value, 0.0) + least);
  return -std::log(std::max(value, 0.0) + least);
}

/// Looks at each seed beside its own past: medians do not see what befalls fewer than half of them.
void LookForBreaks(const Judged& judged, const ValuesBySeed& before, const ValuesBySeed& after,
                   Comparison* comparison) {
  const double step = FarStep(judged, comparison->unit);
  std::vector<double> old_badness, broken;
  for (const auto& [seed, value] : before) {
    old_badness.push_back(Badness(judged, comparison->unit, value));
  }
  for (const auto& [seed, value] : after) {
    if (!IsFarWorse(judged, step, before.at(seed), value)) continue;
    broken.push_back(Badness(judged, comparison->unit, value));
  }
  comparison->broken = broken.size();
  if (before.size() >= kFewestSeeds) {
    comparison->break_p = BreakP(old_badness, broken, after.size());
  }
}

std::optional<Comparison> CompareScore(const std::vector<const RunRecord*>& before,
                                       const std::vector<const RunRecord*>& after,
                                       const std::string& score) {
  Comparison comparison;
  comparison.score = score;
  ValuesBySeed old_values = ValuesOf(before, score, &comparison.unit);
  ValuesBySeed new_values = ValuesOf(after, score, &comparison.unit);
  if (old_values.empty()) return std::nullopt;
  const Judged* judged = FindJudged(score);
  if (judged != nullptr) comparison.gone = FirstGone(old_values, new_values, after, score);
  if (comparison.gone.empty()) comparison.left_out = KeepShared(&old_values, &new_values);
  comparison.old_n = old_values.size();
  comparison.new_n = new_values.size();
  comparison.old_median = Quantile(Plain(old_values), 0.5);
  if (new_values.empty()) {
    comparison.new_median = std::numeric_limits<double>::quiet_NaN();
    return comparison.gone.empty() ? std::nullopt : std::optional(comparison);
  }
  comparison.paired = SameSeeds(old_values, new_values);
  if (judged != nullptr && comparison.paired) {
    LookForBreaks(*judged, old_values, new_values, &comparison);
  }
  comparison.bit_equal = old_values == new_values;
  comparison.new_median = Quantile(Plain(new_values), 0.5);
  comparison.difference = BootstrapMedian(Differences(old_values, new_values, comparison.paired));
  comparison.p = MannWhitneyP(Plain(old_values), Plain(new_values));
  return comparison;
}

void Decide(const Judged& judged, const CompareOptions& options, Comparison* comparison) {
  Comparison& c = *comparison;
  const double change = c.new_median - c.old_median;
  const double effect = judged.smallest_effect > 0
                            ? judged.smallest_effect
                            : options.minimum_effect * std::abs(c.old_median);
  if (!c.gone.empty()) {
    c.change = Change::kGone;
    c.why = fmt::format("{} seeds had a value, {} have one; {}", c.old_n, c.new_n, c.gone);
  } else if (c.bit_equal) {
    c.change = Change::kSame;
    c.why = "equal to the last digit";
  } else if (std::abs(change) <= effect && std::abs(c.difference.low) <= effect &&
             std::abs(c.difference.high) <= effect) {
    c.change = Change::kSame;
    c.why = fmt::format("within {:.2g} of the old median", effect);
  } else if (std::min(c.old_n, c.new_n) < kFewestSeeds) {
    c.change = Change::kCannotTell;
    c.why = fmt::format("{} and {} seeds: fewer than {} per side show nothing", c.old_n, c.new_n,
                        kFewestSeeds);
  } else if (c.p >= options.alpha || std::abs(change) <= effect) {
    c.change = Change::kCannotTell;
    c.why = fmt::format("p = {:.2g} after Holm", c.p);
  } else {
    c.change = (change > 0) == judged.more_is_better ? Change::kBetter : Change::kWorse;
    c.why = fmt::format("p = {:.2g} after Holm", c.p);
  }
  if (c.left_out > 0) {
    c.why += fmt::format("; ignored {} seed{} that only one side has", c.left_out,
                         c.left_out == 1 ? "" : "s");
  }
  const bool undecided = c.change == Change::kSame || c.change == Change::kCannotTell;
  if (undecided && c.break_p < options.alpha) {
    c.change = Change::kUnstable;
    c.why =
        fmt::format("{} of {} seeds got far worse (p = {:.2g} after Holm), the median alone is {}",
                    c.broken, c.new_n, c.break_p, c.why);
  }
}

std::vector<std::string> ScoresToCompare() {
  std::vector<std::string> scores;
  for (const Judged& judged : kJudged) scores.emplace_back(judged.score);
  for (const char* watched : kWatched) scores.emplace_back(watched);
  return scores;
}

/// Equal bits are no question to chance: they take no share of the alarm that is allowed.
bool IsTested(const Comparison& c) {
  return FindJudged(c.score) != nullptr && !c.bit_equal && c.gone.empty();
}

/// The least p that so many seeds can reach, were every new value beyond every old one.
double LeastP(std::size_t old_n, std::size_t new_n) {
  std::vector<double> before(old_n), after(new_n);
  for (std::size_t i = 0; i < old_n; ++i) before[i] = 1e-3 * static_cast<double>(i);
  for (std::size_t i = 0; i < new_n; ++i) after[i] = 1 + 1e-3 * static_cast<double>(i);
  return MannWhitneyP(before, after);
}

void CorrectAndDecide(const CompareOptions& options, std::vector<Comparison>* comparisons) {
  std::vector<double> p_values, break_p_values;
  for (const Comparison& c : *comparisons) {
    if (!IsTested(c)) continue;
    p_values.push_back(c.p);
    break_p_values.push_back(c.break_p);
  }
  const std::vector<double> adjusted = HolmAdjusted(p_values);
  const std::vector<double> breaks_adjusted = HolmAdjusted(break_p_values);
  std::size_t next = 0;
  for (Comparison& c : *comparisons) {
    const Judged* judged = FindJudged(c.score);
    if (judged == nullptr) {
      c.change = Change::kWatched;
      c.why = "depends on the machine and is not judged";
      continue;
    }
    if (IsTested(c)) {
      c.p = std::min(1.0, adjusted[next] / (1 - kAlphaOfBreaks));
      c.break_p = std::min(1.0, breaks_adjusted[next] / kAlphaOfBreaks);
      ++next;
    }
    Decide(*judged, options, &c);
    const double least =
        std::min(1.0, LeastP(c.old_n, c.new_n) * static_cast<double>(p_values.size()) /
                          (1 - kAlphaOfBreaks));
    if (c.change == Change::kCannotTell && least >= options.alpha) {
      c.why += fmt::format("; {} comparisons with {} and {} seeds cannot go below p = {:.2g}",
                           p_values.size(), c.old_n, c.new_n, least);
    }
  }
}

/// Equal bits are promised within one make of processor.
void NoteOtherProcessor(const Results& before, const Results& after,
                        std::vector<Comparison>* comparisons) {
  for (Comparison& c : *comparisons) {
    if (!IsTested(c)) continue;
    c.why += fmt::format("; {} was {}: different bits alone mean nothing", after.provenance.cpu,
                         before.provenance.cpu);
  }
}

}  // namespace

bool SameProcessor(const Results& a, const Results& b) {
  return a.provenance.cpu == b.provenance.cpu;
}

std::string Name(Change change) {
  switch (change) {
    case Change::kBetter:
      return "better";
    case Change::kWorse:
      return "worse";
    case Change::kSame:
      return "same";
    case Change::kWatched:
      return "watched";
    case Change::kUnstable:
      return "unstable";
    case Change::kGone:
      return "gone";
    case Change::kCannotTell:
      break;
  }
  return "cannot tell";
}

bool MoreIsBetter(const std::string& score) {
  const Judged* judged = FindJudged(score);
  return judged != nullptr && judged->more_is_better;
}

bool IsAlarm(Change change) {
  return change == Change::kWorse || change == Change::kUnstable || change == Change::kGone;
}

std::vector<Comparison> Compare(const Results& before, const Results& after,
                                const CompareOptions& options) {
  const auto old_cells = Cells(before), new_cells = Cells(after);
  std::vector<Comparison> comparisons;
  for (const auto& [cell, new_runs] : new_cells) {
    const auto old_runs = old_cells.find(cell);
    if (old_runs == old_cells.end()) continue;
    for (const std::string& score : ScoresToCompare()) {
      std::optional<Comparison> comparison = CompareScore(old_runs->second, new_runs, score);
      if (!comparison) continue;
      std::tie(comparison->scene, comparison->twin, comparison->system) = cell;
      comparisons.push_back(*std::move(comparison));
    }
  }
  CorrectAndDecide(options, &comparisons);
  if (!SameProcessor(before, after)) NoteOtherProcessor(before, after, &comparisons);
  return comparisons;
}

Results BaselineOf(const Results& results) {
  const std::vector<std::string> compared = ScoresToCompare();
  Results baseline = results;
  baseline.verdicts.clear();
  for (RunRecord& run : baseline.runs) {
    run.artifacts.clear();
    run.notes.clear();
    std::erase_if(run.scores, [&](const auto& entry) {
      return std::find(compared.begin(), compared.end(), entry.first) == compared.end();
    });
  }
  return baseline;
}

}  // namespace aisle
