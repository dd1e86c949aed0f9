#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace aisle {

struct Interval {
  double low = 0, high = 0;
};

/// Percentile bootstrap interval of the median (Efron 1979), `resamples` draws. The random numbers
/// come from `seed` alone: the same values give the same interval everywhere. A single value is its
/// own interval. Throws std::invalid_argument on an empty list.
Interval BootstrapMedian(std::span<const double> values, double confidence = 0.95,
                         int resamples = 2000, std::uint64_t seed = 1);

/// Two-sided p of the Mann-Whitney U test (1947): are the two samples drawn alike? Exact, ties by
/// mid-ranks, up to kExactLimit values together; beyond that the normal approximation with tie and
/// continuity correction. 1 where one side is empty or all values are equal.
double MannWhitneyP(std::span<const double> a, std::span<const double> b);
inline constexpr std::size_t kExactLimit = 60;

/// Holm's step-down correction (1979): adjusted p-values in the given order. Rejecting where the
/// adjusted p is below alpha keeps the chance of any false alarm in the family below alpha.
std::vector<double> HolmAdjusted(std::span<const double> p_values);

/// Exact 95 % upper bound on a failure rate after `failures` in `runs` (Clopper-Pearson 1934,
/// one-sided). 1 for no runs.
double FailureRateBound(std::size_t failures, std::size_t runs, double confidence = 0.95);

}  // namespace aisle
