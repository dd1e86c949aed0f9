#include "harness/judge/onset.h"

#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr std::size_t kFewestBefore = 3;
constexpr double kLeastShare = 0.1;
constexpr double kDeviations = 4;

/// Whether every value of `after` lies beyond `median` by more than `least`, all on one side.
bool AllBeyond(std::span<const double> after, double median, double least) {
  const bool above = after.front() > median;
  return std::all_of(after.begin(), after.end(), [&](double value) {
    return above ? value > median + least : value < median - least;
  });
}

double MedianDeviation(std::span<const double> values, double median) {
  std::vector<double> deviations;
  for (const double value : values) deviations.push_back(std::abs(value - median));
  return Quantile(deviations, 0.5);
}

}  // namespace

std::optional<Onset> FindOnset(const std::vector<std::optional<double>>& nights) {
  std::vector<double> values;
  std::vector<std::size_t> night_of;
  for (std::size_t i = 0; i < nights.size(); ++i) {
    if (!nights[i]) continue;
    values.push_back(*nights[i]);
    night_of.push_back(i);
  }
  for (std::size_t k = kFewestBefore; k < values.size(); ++k) {
    const std::span<const double> all(values), before = all.first(k), after = all.subspan(k);
    const double median = Quantile(before, 0.5);
    const double least =
        std::max(kLeastShare * std::abs(median), kDeviations * MedianDeviation(before, median));
    if (AllBeyond(after, median, least)) {
      return Onset{.night = night_of[k], .before = median, .after = Quantile(after, 0.5)};
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> FailingSince(const std::vector<bool>& failed) {
  std::size_t since = failed.size();
  while (since > 0 && failed[since - 1]) --since;
  return since == failed.size() ? std::nullopt : std::optional(since);
}

}  // namespace aisle
