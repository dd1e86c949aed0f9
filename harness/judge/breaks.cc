#include "harness/judge/breaks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace aisle {
namespace {

struct Normal {
  double mean = 0, spread = 0;
};

Normal FitTo(std::span<const double> values) {
  constexpr double kLeastSpread = 0.1;
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::max(kLeastSpread, std::sqrt(squares / (n - 1)))};
}

/// The chance of `least` successes or more in `draws`.
double UpperTail(std::size_t least, std::size_t draws, double chance) {
  if (chance >= 1) return 1;
  const auto n = static_cast<double>(draws);
  double term = std::pow(1 - chance, n), sum = least == 0 ? term : 0;
  for (std::size_t k = 1; k <= draws; ++k) {
    const auto i = static_cast<double>(k);
    term *= (n - i + 1) / i * chance / (1 - chance);
    if (k >= least) sum += term;
  }
  return std::min(1.0, sum);
}

/// The chance that `least` or more of `draws` lie `far` estimated spreads or more above the
/// estimated mean, both estimates being of `seen` values of the same normal distribution. By the
/// trapezoid rule over both estimates, whose error falls exponentially for such bells.
double ChanceBeyond(std::size_t least, std::size_t draws, std::size_t seen, double far) {
  constexpr double kStep = 0.05, kMeanStep = 0.75;
  const auto n = static_cast<double>(seen), freedom = n - 1;
  double weights = 0, sum = 0;
  for (int i = -160; i <= 30; ++i) {
    const double log_spread = kStep * i, spread = std::exp(log_spread);
    const double of_spread = std::exp(freedom * (log_spread - 0.5 * (spread * spread - 1)));
    for (int j = -6; j <= 6; ++j) {
      const double mean = kMeanStep * j;  // in its own standard errors
      const double weight = of_spread * std::exp(-0.5 * mean * mean);
      const double bound = mean / std::sqrt(n) + far * spread;
      weights += weight;
      sum += weight * UpperTail(least, draws, 0.5 * std::erfc(bound / std::sqrt(2.0)));
    }
  }
  return sum / weights;
}

}  // namespace

double BreakP(std::span<const double> before, std::span<const double> broken,
              std::span<const double> unbroken) {
  if (before.size() < 2 || broken.empty()) return 1;
  const std::size_t new_seeds = broken.size() + unbroken.size();
  Normal old = FitTo(before);
  if (unbroken.size() > 1) old.spread = std::max(old.spread, FitTo(unbroken).spread);
  std::vector<double> worst_first(broken.begin(), broken.end());
  std::sort(worst_first.begin(), worst_first.end(), std::greater<>());
  const std::size_t half = std::max<std::size_t>(1, new_seeds / 2);
  double p = 1;
  for (std::size_t k = 1; k <= std::min(half, worst_first.size()); ++k) {
    const double far = (worst_first[k - 1] - old.mean) / old.spread;
    p = std::min(p, ChanceBeyond(k, new_seeds, before.size(), far));
  }
  return std::min(1.0, p * static_cast<double>(half));
}

}  // namespace aisle
