#include "harness/judge/change_size.h"

#include <limits>
#include <set>

#include "harness/record/seed_values.h"

namespace aisle {
namespace {

bool IsOf(const RunRecord& run, const Comparison& c) {
  return run.spec.scene == c.scene && run.spec.twin == c.twin && run.spec.system.name == c.system;
}

using NameOfRun = std::string (*)(const RunRecord&);

std::set<std::string> NamesOf(const Results& results, NameOfRun name) {
  std::set<std::string> names;
  for (const RunRecord& run : results.runs) names.insert(name(run));
  return names;
}

/// Alarms, then what got better, of each first what is of systems; then all else.
int Rank(const Comparison& c) {
  const int of_change = IsAlarm(c.change) ? 0 : c.change == Change::kBetter ? 2 : 4;
  return of_change < 4 && c.cells == 0 ? of_change + 1 : of_change;
}

/// Which way to look for the seed that made the change. Where some seeds broke, the medians hardly
/// moved, and perhaps the other way.
double DirectionOf(const Comparison& c) {
  if (c.change == Change::kUnstable) return MoreIsBetter(c.score) ? -1 : 1;
  return c.new_median < c.old_median ? -1 : 1;
}

}  // namespace

std::string PercentOfChange(const Comparison& c) {
  if (c.cells > 0) return c.factor ? fmt::format("{:+.1f} %", 100 * (*c.factor - 1)) : "";
  if (c.old_median == 0 || c.new_n == 0) return "";
  return fmt::format("{:+.1f} %", 100 * (c.new_median - c.old_median) / std::abs(c.old_median));
}

double SizeOf(const Comparison& comparison) {
  constexpr double kTiny = 1e-9;
  if (!comparison.gone.empty() || comparison.new_n == 0) {
    return std::numeric_limits<double>::infinity();
  }
  if (comparison.factor) return std::abs(std::log(std::max(*comparison.factor, kTiny)));
  return std::abs(std::log(std::max(std::abs(comparison.new_median), kTiny) /
                           std::max(std::abs(comparison.old_median), kTiny)));
}

void LargestFirst(std::vector<Comparison>* comparisons) {
  std::stable_sort(comparisons->begin(), comparisons->end(),
                   [](const Comparison& a, const Comparison& b) {
                     return std::pair(Rank(a), -SizeOf(a)) < std::pair(Rank(b), -SizeOf(b));
                   });
}

std::optional<SeedChange> FarthestSeed(const Results& before, const Results& after,
                                       const Comparison& comparison) {
  const double direction = DirectionOf(comparison);
  std::optional<SeedChange> farthest;
  double reach = 0;
  for (const RunRecord& old_run : before.runs) {
    const auto old_value =
        IsOf(old_run, comparison) ? ValueOf(old_run, comparison.score) : std::nullopt;
    if (!old_value) continue;
    for (const RunRecord& new_run : after.runs) {
      if (!IsOf(new_run, comparison) || new_run.spec.seed != old_run.spec.seed ||
          new_run.spec.repeat != old_run.spec.repeat) {
        continue;
      }
      const auto new_value = ValueOf(new_run, comparison.score);
      const double moved = new_value ? direction * (*new_value - *old_value)
                                     : std::numeric_limits<double>::infinity();
      if (farthest && moved <= reach) continue;
      farthest = {&old_run, &new_run, *old_value, new_value};
      reach = moved;
    }
  }
  return farthest;
}

std::string WhyNothingShared(const Results& before, const Results& after) {
  constexpr std::size_t kNamed = 4;
  const std::pair<const char*, NameOfRun> kinds[] = {
      {"scene", [](const RunRecord& run) { return run.spec.scene; }},
      {"twin", [](const RunRecord& run) { return run.spec.twin; }},
      {"system", [](const RunRecord& run) { return run.spec.system.name; }},
      {"combination of scene, twin and system", [](const RunRecord& run) {
         return fmt::format("{} {} {}", run.spec.scene, run.spec.twin, run.spec.system.name);
       }}};
  for (const auto& [kind, name] : kinds) {
    const std::set<std::string> old_names = NamesOf(before, name), new_names = NamesOf(after, name);
    const bool shared = std::any_of(old_names.begin(), old_names.end(),
                                    [&](const auto& one) { return new_names.contains(one); });
    if (shared) continue;
    const auto listed = [&](const std::set<std::string>& names) {
      if (names.empty()) return std::string("none");
      std::vector<std::string> few(names.begin(), names.end());
      if (few.size() > kNamed) few.resize(kNamed);
      return fmt::format("{}{}", fmt::join(few, ", "), names.size() > kNamed ? ", …" : "");
    };
    return fmt::format("the two share no {}: {} before, {} after", kind, listed(old_names),
                       listed(new_names));
  }
  return "";
}

}  // namespace aisle
