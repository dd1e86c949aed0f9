#include "harness/record/seed_values.h"

#include <set>
#include <tuple>

#include "harness/score/statistics.h"

namespace aisle {
namespace {

/// What runs have in common that differ by their repeat, or by their system.
using SeedOfScene = std::tuple<std::string, std::string, std::uint64_t>;

SeedOfScene SeedOfRun(const RunRecord& run) {
  return {run.spec.scene, run.spec.twin, run.spec.seed};
}

std::map<SeedOfScene, double> Medians(
    const std::vector<const RunRecord*>& runs,
    const std::function<std::optional<double>(const RunRecord&)>& value_of) {
  std::map<SeedOfScene, std::vector<double>> repeats;
  for (const RunRecord* run : runs) {
    if (const auto value = value_of(*run)) repeats[SeedOfRun(*run)].push_back(*value);
  }
  std::map<SeedOfScene, double> medians;
  for (const auto& [seed, values] : repeats) medians[seed] = Quantile(values, 0.5);
  return medians;
}

}  // namespace

std::optional<double> ValueOf(const RunRecord& run, const std::string& score) {
  const auto at = run.scores.find(score);
  return at == run.scores.end() ? std::nullopt : at->second.value;
}

ValuesBySeed ValuesOf(const std::vector<const RunRecord*>& runs, const std::string& score,
                      std::string* unit) {
  const auto value_of = [&](const RunRecord& run) -> std::optional<double> {
    const auto at = run.scores.find(score);
    if (at == run.scores.end() || !at->second.value) return std::nullopt;
    *unit = at->second.unit;
    return at->second.value;
  };
  ValuesBySeed values;
  for (const auto& [seed, value] : Medians(runs, value_of)) values[std::get<2>(seed)] = value;
  return values;
}

std::vector<double> Plain(const ValuesBySeed& values) {
  std::vector<double> plain;
  for (const auto& [seed, value] : values) plain.push_back(value);
  return plain;
}

std::vector<double> MediansBySeed(
    const std::vector<const RunRecord*>& runs,
    const std::function<std::optional<double>(const RunRecord&)>& value_of) {
  std::vector<double> plain;
  for (const auto& [seed, value] : Medians(runs, value_of)) plain.push_back(value);
  return plain;
}

std::size_t CountSeeds(const std::vector<const RunRecord*>& runs) {
  std::set<SeedOfScene> seeds;
  for (const RunRecord* run : runs) seeds.insert(SeedOfRun(*run));
  return seeds.size();
}

}  // namespace aisle
