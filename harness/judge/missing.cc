#include "harness/judge/missing.h"

#include <algorithm>

#include "harness/common/counted.h"
#include "harness/record/record.h"

namespace aisle {
std::map<CellOfNight, std::set<std::uint64_t>> SeedsByCell(const Results& results) {
  std::map<CellOfNight, std::set<std::uint64_t>> seeds;
  for (const RunRecord& run : results.runs) {
    seeds[CellOf(run.spec)].insert(run.spec.seed);
  }
  return seeds;
}

std::vector<MissingRuns> MissingRunsOf(const Results& before, const Results& after) {
  std::vector<MissingRuns> missing;
  const auto now = SeedsByCell(after);
  for (const auto& [cell, seeds] : SeedsByCell(before)) {
    const auto at = now.find(cell);
    MissingRuns of_cell;
    std::tie(of_cell.scene, of_cell.twin, of_cell.system) = cell;
    of_cell.is_whole = at == now.end();
    const std::set<std::uint64_t> there = of_cell.is_whole ? std::set<std::uint64_t>() : at->second;
    std::set_difference(seeds.begin(), seeds.end(), there.begin(), there.end(),
                        std::back_inserter(of_cell.seeds));
    if (!of_cell.seeds.empty()) missing.push_back(std::move(of_cell));
  }
  return missing;
}

std::string InWords(const std::vector<MissingRuns>& missing) {
  std::size_t cells = 0, seeds = 0;
  for (const MissingRuns& one : missing) {
    cells += one.is_whole ? 1 : 0;
    seeds += one.is_whole ? 0 : one.seeds.size();
  }
  const std::size_t partly = missing.size() - cells;
  if (missing.empty()) return "";
  std::string text = cells > 0 ? Counted(cells, "cell") : "";
  if (partly > 0) {
    text += fmt::format("{}{} of {}", text.empty() ? "" : " and ", Counted(seeds, "seed"),
                        Counted(partly, cells > 0 ? "other" : "cell"));
  }
  return text + (cells + seeds == 1 ? " is missing" : " are missing");
}

std::vector<std::string> UnfinishedRuns(const Results& results,
                                        const std::vector<RunSpec>& planned) {
  std::set<std::string> finished, unfinished;
  for (const RunRecord& run : results.runs) {
    (IsComplete(run.status) ? finished : unfinished).insert(RunId(run.spec));
  }
  for (const RunSpec& spec : planned) {
    if (!finished.contains(RunId(spec))) unfinished.insert(RunId(spec));
  }
  // A run of which nothing is left has a verdict alone, where a folder has lost its plan.
  const std::string completes = ": completes";
  for (const Verdict& verdict : results.verdicts) {
    if (verdict.passed || !verdict.name.ends_with(completes)) continue;
    unfinished.insert(verdict.name.substr(0, verdict.name.size() - completes.size()));
  }
  return {unfinished.begin(), unfinished.end()};
}

}  // namespace aisle
