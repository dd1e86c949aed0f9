#include "harness/judge/seed_values.h"

#include "harness/score/statistics.h"

namespace aisle {

ValuesBySeed ValuesOf(const std::vector<const RunRecord*>& runs, const std::string& score,
                      std::string* unit) {
  std::map<std::uint64_t, std::vector<double>> repeats;  // by seed
  for (const RunRecord* run : runs) {
    const auto at = run->scores.find(score);
    if (at == run->scores.end() || !at->second.value) continue;
    repeats[run->spec.seed].push_back(*at->second.value);
    *unit = at->second.unit;
  }
  ValuesBySeed values;
  for (const auto& [seed, of_seed] : repeats) values[seed] = Quantile(of_seed, 0.5);
  return values;
}

std::vector<double> Plain(const ValuesBySeed& values) {
  std::vector<double> plain;
  for (const auto& [seed, value] : values) plain.push_back(value);
  return plain;
}

}  // namespace aisle
