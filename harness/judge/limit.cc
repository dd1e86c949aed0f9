#include "harness/judge/limit.h"

#include <limits>

#include "harness/judge/cell.h"
#include "harness/record/seed_values.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

std::string Name(const CellOfNight& cell) {
  const auto& [scene, twin, system] = cell;
  return fmt::format("{} {} {}", scene, twin, system);
}

bool Matches(const Limit& limit, const RunSpec& spec) {
  return (limit.scene.empty() || limit.scene == spec.scene) &&
         (limit.twin.empty() || limit.twin == spec.twin) &&
         (limit.system.empty() || limit.system == spec.system.name);
}

/// Runs that differ only by seed, in the order of the suite.
std::vector<std::pair<CellOfNight, std::vector<const RunRecord*>>> ByCell(
    const std::vector<RunRecord>& runs, const Limit& limit) {
  std::vector<std::pair<CellOfNight, std::vector<const RunRecord*>>> cells;
  for (const RunRecord& run : runs) {
    if (!Matches(limit, run.spec)) continue;
    const CellOfNight cell = CellOf(run.spec);
    auto at = std::find_if(cells.begin(), cells.end(),
                           [&](const auto& entry) { return entry.first == cell; });
    if (at == cells.end()) at = cells.insert(cells.end(), {cell, {}});
    at->second.push_back(&run);
  }
  return cells;
}

/// Why a run has no value of a score.
std::string WhyAbsent(const RunRecord& run, const std::string& score) {
  const auto at = run.scores.find(score);
  if (at != run.scores.end()) return at->second.absent;
  return run.status_why.empty() ? "the run has no such score" : run.status_why;
}

/// How far a value lies beyond the nearer bound; not above zero where it holds both.
double Excess(const Limit& limit, double value) {
  double excess = -std::numeric_limits<double>::infinity();
  if (limit.max) excess = std::max(excess, value - *limit.max);
  if (limit.min) excess = std::max(excess, *limit.min - value);
  return excess;
}

/// The bound that a value breaks; where it breaks none, the nearer one.
std::optional<double> NearestBound(const Limit& limit, double value) {
  if (!limit.max || !limit.min) return limit.max ? limit.max : limit.min;
  return value - *limit.max >= *limit.min - value ? limit.max : limit.min;
}

/// "median of 9 seeds"; "median of 5 repeats" where one seed was driven several times.
std::string WhatIsHeld(std::size_t seeds, std::size_t runs) {
  if (seeds > 1) return fmt::format("median of {} seeds", seeds);
  return runs > 1 ? fmt::format("median of {} repeats", runs) : "value";
}

Verdict Bound(const std::string& name, const Limit& limit, double value, const std::string& what,
              const std::string& unit) {
  Verdict verdict{.name = name,
                  .passed = true,
                  .flaky = false,
                  .value = value,
                  .limit = NearestBound(limit, value),
                  .why = ""};
  const std::string shown_unit = unit == "1" ? "" : " " + unit;
  const auto hold = [&](double bound, bool holds, const char* relation) {
    verdict.passed = verdict.passed && holds;
    verdict.why += fmt::format("{}{} {:.6g}{} is {}{} {:.6g}", verdict.why.empty() ? "" : "; ",
                               what, value, shown_unit, holds ? "" : "not ", relation, bound);
  };
  if (limit.max) hold(*limit.max, value <= *limit.max, "at most");
  if (limit.min) hold(*limit.min, value >= *limit.min, "at least");
  return verdict;
}

std::string BoundInWords(const Limit& limit) {
  std::string text = limit.max ? fmt::format("at most {:.6g}", *limit.max) : "";
  if (limit.min) text += fmt::format("{}at least {:.6g}", text.empty() ? "" : " and ", *limit.min);
  return text;
}

/// Every seed by itself: "5 of 9 seeds are at least 1, needed are 9; the worst is 0 of seed 3".
Verdict JudgeShare(const Limit& limit, const CellOfNight& cell,
                   const std::vector<const RunRecord*>& runs) {
  std::map<std::uint64_t, bool> holds;  // by seed; all its repeats must
  const RunRecord *worst = nullptr, *without = nullptr;
  for (const RunRecord* run : runs) {
    const std::optional<double> value = ValueOf(*run, limit.score);
    bool& seed_holds = holds.try_emplace(run->spec.seed, true).first->second;
    seed_holds = seed_holds && value && Excess(limit, *value) <= 0;
    if (!value && without == nullptr) without = run;
    if (value && (worst == nullptr ||
                  Excess(limit, *value) > Excess(limit, *ValueOf(*worst, limit.score)))) {
      worst = run;
    }
  }
  const auto held = static_cast<std::size_t>(
      std::count_if(holds.begin(), holds.end(), [](const auto& seed) { return seed.second; }));
  constexpr double kRounding = 1e-9;  // 0.07 of 100 seeds are seven
  const auto needed = static_cast<std::size_t>(
      std::ceil(*limit.share * static_cast<double>(holds.size()) - kRounding));
  Verdict verdict{.name = Name(cell) + ": " + limit.score,
                  .passed = held >= needed,
                  .flaky = false,
                  .value = {},
                  .limit = limit.max ? limit.max : limit.min,
                  .why = ""};
  verdict.why = fmt::format("{} of {} seeds {} {}, needed {} {}", held, holds.size(),
                            held == 1 ? "is" : "are", BoundInWords(limit),
                            needed == 1 ? "is" : "are", needed);
  if (worst != nullptr) {
    const Score& score = worst->scores.at(limit.score);
    verdict.value = score.value;
    verdict.limit = NearestBound(limit, *score.value);
    verdict.why += fmt::format("; the worst is {:.6g}{} of seed {}", *score.value,
                               score.unit == "1" ? "" : " " + score.unit, worst->spec.seed);
  }
  if (without != nullptr) {
    verdict.why += fmt::format("; seed {} has no value: {}", without->spec.seed,
                               WhyAbsent(*without, limit.score));
  }
  return verdict;
}

Verdict JudgeMedian(const Limit& limit, const CellOfNight& cell,
                    const std::vector<const RunRecord*>& runs) {
  const std::string name = Name(cell) + ": " + limit.score;
  for (const RunRecord* run : runs) {
    if (ValueOf(*run, limit.score)) continue;
    return {.name = name,
            .passed = false,
            .flaky = false,
            .value = {},
            .limit = limit.max ? limit.max : limit.min,
            .why = fmt::format("seed {} has no value: {}", run->spec.seed,
                               WhyAbsent(*run, limit.score))};
  }
  std::string unit;
  const std::vector<double> of_seeds = Plain(ValuesOf(runs, limit.score, &unit));
  return Bound(name, limit, Quantile(of_seeds, 0.5), WhatIsHeld(of_seeds.size(), runs.size()),
               unit);
}

std::string Filters(const Limit& limit) {
  std::string text;
  for (const auto& [key, value] : {std::pair("scene", limit.scene), std::pair("twin", limit.twin),
                                   std::pair("system", limit.system)}) {
    if (!value.empty()) text += fmt::format(" {} {}", key, value);
  }
  return text.empty() ? " any run" : text;
}

}  // namespace

std::vector<Verdict> JudgeRuns(const std::vector<RunRecord>& runs) {
  std::vector<Verdict> verdicts;
  for (const RunRecord& run : runs) {
    if (IsComplete(run.status)) continue;
    verdicts.push_back({.name = RunId(run.spec) + ": completes",
                        .passed = false,
                        .flaky = run.flaky,
                        .value = {},
                        .limit = {},
                        .why = Name(run.status) + ": " + run.status_why,
                        .scene = run.spec.scene,
                        .twin = run.spec.twin,
                        .system = run.spec.system.name});
  }
  return verdicts;
}

std::vector<Verdict> JudgeLimits(const std::vector<RunRecord>& runs,
                                 const std::vector<Limit>& limits) {
  std::vector<Verdict> verdicts;
  for (const Limit& limit : limits) {
    const auto cells = ByCell(runs, limit);
    if (cells.empty()) {
      verdicts.push_back({.name = "limit on " + limit.score,
                          .passed = false,
                          .flaky = false,
                          .value = {},
                          .limit = {},
                          .why = "no run matches" + Filters(limit)});
    }
    for (const auto& [cell, of_cell] : cells) {
      verdicts.push_back(limit.share ? JudgeShare(limit, cell, of_cell)
                                     : JudgeMedian(limit, cell, of_cell));
      Verdict& verdict = verdicts.back();
      std::tie(verdict.scene, verdict.twin, verdict.system) = cell;
    }
  }
  return verdicts;
}

std::vector<Verdict> Judge(const std::vector<RunRecord>& runs, const std::vector<Limit>& limits) {
  std::vector<Verdict> verdicts = JudgeRuns(runs);
  const std::vector<Verdict> held = JudgeLimits(runs, limits);
  verdicts.insert(verdicts.end(), held.begin(), held.end());
  return verdicts;
}

bool AllPassed(const Results& results) {
  return std::all_of(results.verdicts.begin(), results.verdicts.end(),
                     [](const Verdict& verdict) { return verdict.passed; });
}

}  // namespace aisle
