#include "harness/judge/compare.h"

#include "harness/judge/breaks.h"
#include "harness/judge/cell.h"
#include "harness/judge/judged.h"
#include "harness/judge/paired.h"
#include "harness/judge/pooled.h"
#include "harness/record/seed_values.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr const char* kWatched[] = {"ms_process_mean", "ms_render_mean", "peak_rss_mib"};

RunsByCell Cells(const Results& results) {
  RunsByCell cells;
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
  if (paired) return PairedDifferences(before, after);
  const double old_median = Quantile(Plain(before), 0.5);
  std::vector<double> differences;
  for (const auto& [seed, value] : after) differences.push_back(value - old_median);
  return differences;
}

/// The one nearer to zero; zero where they lie on either side of it.
double LesserOf(double one, double other) {
  if (one * other <= 0) return 0;
  return std::abs(one) < std::abs(other) ? one : other;
}

/// How a seed fared: its runs, as many as its system's `repeats` where some are not there.
struct RunsOfSeed {
  std::size_t runs = 0, with_value = 0;
  const RunRecord* without = nullptr;  ///< the first that has no value
};

std::map<std::uint64_t, RunsOfSeed> CountBySeed(const std::vector<const RunRecord*>& runs,
                                                const std::string& score) {
  std::map<std::uint64_t, RunsOfSeed> counts;
  for (const RunRecord* run : runs) {
    RunsOfSeed& of_seed = counts[run->spec.seed];
    ++of_seed.runs;
    if (ValueOf(*run, score)) {
      ++of_seed.with_value;
    } else if (of_seed.without == nullptr) {
      of_seed.without = run;
    }
  }
  for (const RunRecord* run : runs) {
    const auto& external = run->spec.system.external;
    RunsOfSeed& of_seed = counts[run->spec.seed];
    of_seed.runs =
        std::max(of_seed.runs, static_cast<std::size_t>(external ? external->repeats : 1));
  }
  return counts;
}

/// Why a run has no value of a score; null stands for one that is not there.
std::string WhyWithout(const RunRecord* run, const std::string& score) {
  if (run == nullptr) return "a repeat is missing";
  const auto at = run->scores.find(score);
  if (at != run->scores.end() && !at->second.absent.empty()) return at->second.absent;
  return run->status_why.empty() ? "the run has no such score" : run->status_why;
}

/// "seed 3: nothing was rejected": the first that ran again and has a value in fewer of its runs,
/// or in none. Its value is a median over repeats, which sees nothing of one that was lost. Fewer
/// repeats by intention are not fewer of them.
std::string FirstGone(const std::vector<const RunRecord*>& before,
                      const std::vector<const RunRecord*>& after, const std::string& score) {
  const auto then = CountBySeed(before, score), now = CountBySeed(after, score);
  for (const auto& [seed, old_runs] : then) {
    const auto at = now.find(seed);
    if (at == now.end()) continue;  // told as a whole (MissingRunsOf)
    const RunsOfSeed& runs = at->second;
    if (runs.with_value * old_runs.runs >= old_runs.with_value * runs.runs) continue;
    const std::string repeats =
        runs.runs > 1 ? fmt::format("{} of {} repeats have a value, before {} of {}; ",
                                    runs.with_value, runs.runs, old_runs.with_value, old_runs.runs)
                      : "";
    return fmt::format("seed {}: {}{}", seed, repeats, WhyWithout(runs.without, score));
  }
  return "";
}

/// Looks at each seed beside its own past: medians do not see what befalls fewer than half of them.
void LookForBreaks(const JudgedScore& judged, const ValuesBySeed& before, const ValuesBySeed& after,
                   Comparison* comparison) {
  std::vector<double> old_badness, broken, unbroken;
  for (const auto& [seed, value] : before) {
    old_badness.push_back(Badness(judged, comparison->unit, value));
  }
  for (const auto& [seed, value] : after) {
    const bool is_broken = IsFarWorse(judged, comparison->unit, before.at(seed), value);
    (is_broken ? broken : unbroken).push_back(Badness(judged, comparison->unit, value));
  }
  comparison->broken = broken.size();
  if (before.size() >= kFewestSeeds) {
    comparison->break_p = BreakP(old_badness, broken, unbroken);
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
  const JudgedScore* judged = FindJudged(score);
  if (judged != nullptr) comparison.gone = FirstGone(before, after, score);
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
  const std::vector<double> differences = Differences(old_values, new_values, comparison.paired);
  comparison.difference = BootstrapMedian(differences);
  comparison.moved = comparison.new_median - comparison.old_median;
  comparison.p = MannWhitneyP(Plain(old_values), Plain(new_values));
  if (judged != nullptr && comparison.paired) {
    comparison.moved = LesserOf(comparison.moved, Quantile(differences, 0.5));
    comparison.p = StrongerP(
        comparison.p, StudentP(Worsenings(*judged, comparison.unit, old_values, new_values)));
  }
  return comparison;
}

void Decide(const JudgedScore& judged, const CompareOptions& options, Comparison* comparison) {
  Comparison& c = *comparison;
  const double effect = SmallestEffect(judged, options.minimum_effect, c.old_median);
  if (!c.gone.empty()) {
    c.change = Change::kGone;
    c.why = c.old_n == c.new_n
                ? c.gone
                : fmt::format("{} seeds had a value, {} have one; {}", c.old_n, c.new_n, c.gone);
  } else if (c.bit_equal) {
    c.change = Change::kSame;
    c.why = "equal to the last digit";
  } else if (std::abs(c.moved) <= effect && std::abs(c.difference.low) <= effect &&
             std::abs(c.difference.high) <= effect) {
    c.change = Change::kSame;
    c.why = fmt::format("within {:.2g} of the old median", effect);
  } else if (std::min(c.old_n, c.new_n) < kFewestSeeds) {
    c.change = Change::kCannotTell;
    c.why = fmt::format("{} and {} seeds: fewer than {} per side show nothing", c.old_n, c.new_n,
                        kFewestSeeds);
  } else if (c.p >= options.alpha || std::abs(c.moved) <= effect) {
    c.change = Change::kCannotTell;
    c.why = fmt::format("p = {:.2g} after Holm{}", c.p,
                        c.p < options.alpha ? ", by less than the minimum effect" : "");
  } else {
    c.change = (c.moved > 0) == judged.more_is_better ? Change::kBetter : Change::kWorse;
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
  for (const JudgedScore& judged : JudgedScores()) scores.emplace_back(judged.score);
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
    const JudgedScore* judged = FindJudged(c.score);
    if (judged == nullptr) {
      c.change = Change::kWatched;
      c.why = "depends on the machine and is not judged";
      continue;
    }
    if (IsTested(c)) {
      c.p = std::min(1.0, adjusted[next] / kAlphaOfCells);
      c.break_p = std::min(1.0, breaks_adjusted[next] / kAlphaOfBreaks);
      ++next;
    }
    Decide(*judged, options, &c);
    if (c.change != Change::kCannotTell || c.paired) continue;  // of pairs no p is the least
    const double least = std::min(
        1.0, LeastP(c.old_n, c.new_n) * static_cast<double>(p_values.size()) / kAlphaOfCells);
    if (least >= options.alpha) {
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
  const JudgedScore* judged = FindJudged(score);
  return judged != nullptr && judged->more_is_better;
}

bool IsAlarm(Change change) {
  return change == Change::kWorse || change == Change::kUnstable || change == Change::kGone;
}

std::string NameOfCell(const Comparison& comparison) {
  const Comparison& c = comparison;
  if (c.cells > 0) return "all cells of " + c.system;
  return fmt::format("{} {} {}", c.scene, c.twin, c.system);
}

std::vector<Comparison> Compare(const Results& before, const Results& after,
                                const CompareOptions& options) {
  const RunsByCell old_cells = Cells(before), new_cells = Cells(after);
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
  std::vector<Comparison> pooled = ComparePooled(old_cells, new_cells, options);
  comparisons.insert(comparisons.begin(), std::make_move_iterator(pooled.begin()),
                     std::make_move_iterator(pooled.end()));
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
