#pragma once

#include <cstddef>
#include <span>

namespace aisle {

/// The usual summary of a list of errors. `std` is the population's (divided by n), the median of
/// an even number of values is the mean of the two middle ones: as numpy and evo have it.
struct Statistics {
  std::size_t n = 0;
  double rmse = 0, mean = 0, median = 0, std = 0, min = 0, max = 0, sse = 0;
};

/// All zero, n = 0 included, for an empty list. Sums run in the given order.
Statistics Summarize(std::span<const double> errors);

/// The q-quantile, q in [0, 1], linearly interpolated between order statistics (numpy's default).
/// Infinite values are allowed. Throws std::invalid_argument on an empty list or a q outside.
double Quantile(std::span<const double> values, double q);

}  // namespace aisle
