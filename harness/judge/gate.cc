#include "harness/judge/gate.h"

#include <set>

namespace aisle {
namespace {

using Cell = std::tuple<std::string, std::string, std::string>;  // scene, twin, system

std::map<Cell, std::set<std::uint64_t>> SeedsByCell(const Results& results) {
  std::map<Cell, std::set<std::uint64_t>> seeds;
  for (const RunRecord& run : results.runs) {
    seeds[{run.spec.scene, run.spec.twin, run.spec.system.name}].insert(run.spec.seed);
  }
  return seeds;
}

Verdict Failed(const Cell& cell, const std::string& why) {
  const auto& [scene, twin, system] = cell;
  return {.name = fmt::format("{} {} {}: baseline", scene, twin, system),
          .passed = false,
          .flaky = false,
          .value = {},
          .limit = {},
          .why = why,
          .scene = scene,
          .twin = twin,
          .system = system};
}

Verdict OfScore(const Comparison& c) {
  const std::string unit = c.unit == "1" ? "" : " " + c.unit;
  const std::string now = c.new_n > 0 ? fmt::format("{:.4g}", c.new_median) : "nothing";
  return {
      .name = fmt::format("{} {} {}: {} against the baseline", c.scene, c.twin, c.system, c.score),
      .passed = !IsAlarm(c.change),
      .flaky = false,
      .value = c.new_n > 0 ? std::optional(c.new_median) : std::nullopt,
      .limit = c.old_median,
      .why =
          fmt::format("{}: {} was {:.4g}{} ({})", Name(c.change), now, c.old_median, unit, c.why),
      .scene = c.scene,
      .twin = c.twin,
      .system = c.system};
}

}  // namespace

std::vector<Verdict> GateVerdicts(const Results& baseline, const Results& night,
                                  const CompareOptions& options) {
  std::vector<Verdict> verdicts;
  const auto tonight = SeedsByCell(night);
  for (const auto& [cell, seeds] : SeedsByCell(baseline)) {
    const auto now = tonight.find(cell);
    if (now == tonight.end()) {
      verdicts.push_back(Failed(cell, "the baseline has this, tonight has not"));
      continue;
    }
    std::vector<std::uint64_t> missing;
    std::set_difference(seeds.begin(), seeds.end(), now->second.begin(), now->second.end(),
                        std::back_inserter(missing));
    if (missing.empty()) continue;
    verdicts.push_back(Failed(
        cell, fmt::format("the baseline has seeds {}, tonight has not", fmt::join(missing, ", "))));
  }
  for (const Comparison& c : Compare(baseline, night, options)) {
    if (c.change != Change::kWatched) verdicts.push_back(OfScore(c));
  }
  return verdicts;
}

std::string BlindFor(const Results& baseline) {
  const auto cells = SeedsByCell(baseline);
  const auto few = [](const auto& cell) { return cell.second.size() < kFewestSeeds; };
  const auto count = std::count_if(cells.begin(), cells.end(), few);
  if (count == 0) return {};
  return fmt::format(
      "{} of {} cells of the baseline have fewer than {} seeds: there a change of a median can "
      "never be told from chance",
      count, cells.size(), kFewestSeeds);
}

}  // namespace aisle
