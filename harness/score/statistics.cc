#include "harness/score/statistics.h"

#include <stdexcept>

namespace aisle {
namespace {

double Interpolate(double low, double high, double weight) {
  // Not low + w·(high - low): that is NaN between a finite value and infinity at weight 0.
  return weight == 0 ? low : (1 - weight) * low + weight * high;
}

double QuantileOfSorted(const std::vector<double>& sorted, double q) {
  const double rank = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return Interpolate(sorted[below], sorted[above], rank - static_cast<double>(below));
}

std::vector<double> Sorted(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

}  // namespace

Statistics Summarize(std::span<const double> errors) {
  Statistics result;
  result.n = errors.size();
  if (errors.empty()) return result;
  const auto count = static_cast<double>(errors.size());
  double sum = 0;
  for (const double error : errors) {
    sum += error;
    result.sse += error * error;
  }
  result.mean = sum / count;
  result.rmse = std::sqrt(result.sse / count);
  double spread = 0;
  for (const double error : errors) spread += (error - result.mean) * (error - result.mean);
  result.std = std::sqrt(spread / count);
  const std::vector<double> sorted = Sorted(errors);
  result.min = sorted.front();
  result.max = sorted.back();
  result.median = QuantileOfSorted(sorted, 0.5);
  return result;
}

double Quantile(std::span<const double> values, double q) {
  if (values.empty()) throw std::invalid_argument("Quantile: no values");
  if (!(q >= 0 && q <= 1)) throw std::invalid_argument(fmt::format("Quantile: q = {}", q));
  return QuantileOfSorted(Sorted(values), q);
}

}  // namespace aisle
