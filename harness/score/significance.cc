#include "harness/score/significance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "harness/common/mix.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

/// The n-th number of a stream, from its content alone.
std::uint64_t Random(std::uint64_t seed, std::uint64_t n) {
  return Mix(seed * kGolden + n * 0xD1B54A32D192ED03u + 0x2545F4914F6CDD1Du);
}

/// Twice the mid-ranks of both samples together, a first: whole numbers, so sums are exact.
std::vector<int> DoubledRanks(std::span<const double> a, std::span<const double> b) {
  std::vector<double> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  std::vector<double> sorted = all;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> ranks;
  for (const double value : all) {
    const auto below = std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin();
    const auto through = std::upper_bound(sorted.begin(), sorted.end(), value) - sorted.begin();
    ranks.push_back(static_cast<int>(below + through + 1));
  }
  return ranks;
}

/// Share of all ways to choose the first sample whose rank sum lies at least as far from the mean.
double ExactP(const std::vector<int>& ranks, std::size_t chosen) {
  const auto total = static_cast<std::size_t>(std::accumulate(ranks.begin(), ranks.end(), 0));
  // ways[k][s]: choices of k ranks that add up to s. Doubles hold these counts well enough.
  std::vector<std::vector<double>> ways(chosen + 1, std::vector<double>(total + 1, 0.0));
  ways[0][0] = 1;
  for (const int rank : ranks) {
    const auto r = static_cast<std::size_t>(rank);
    for (std::size_t k = chosen; k >= 1; --k) {
      for (std::size_t s = total; s >= r; --s) ways[k][s] += ways[k - 1][s - r];
    }
  }
  const auto observed = static_cast<double>(
      std::accumulate(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(chosen), 0));
  const double mean =
      static_cast<double>(total) * static_cast<double>(chosen) / static_cast<double>(ranks.size());
  const double distance = std::abs(observed - mean) - 1e-9;
  double all = 0, extreme = 0;
  for (std::size_t s = 0; s <= total; ++s) {
    all += ways[chosen][s];
    if (std::abs(static_cast<double>(s) - mean) >= distance) extreme += ways[chosen][s];
  }
  return std::min(1.0, extreme / all);
}

double NormalP(const std::vector<int>& doubled_ranks, std::size_t n) {
  const auto total = static_cast<double>(doubled_ranks.size());
  const auto first = static_cast<double>(n), second = total - first;
  double sum = 0, spread = 0;
  for (std::size_t i = 0; i < doubled_ranks.size(); ++i) {
    const double rank = doubled_ranks[i] / 2.0;
    if (i < n) sum += rank;
    spread += (rank - (total + 1) / 2) * (rank - (total + 1) / 2);
  }
  const double variance = first * second * spread / (total * (total - 1));
  if (variance <= 0) return 1;
  const double off = std::abs(sum - first * (total + 1) / 2) - 0.5;
  return std::min(1.0, std::erfc(std::max(off, 0.0) / std::sqrt(2 * variance)));
}

double BinomialTail(std::size_t failures, std::size_t runs, double rate) {
  double sum = 0;
  for (std::size_t k = 0; k <= failures; ++k) {
    const double log_choose = std::lgamma(static_cast<double>(runs) + 1) -
                              std::lgamma(static_cast<double>(k) + 1) -
                              std::lgamma(static_cast<double>(runs - k) + 1);
    sum += std::exp(log_choose + static_cast<double>(k) * std::log(rate) +
                    static_cast<double>(runs - k) * std::log1p(-rate));
  }
  return sum;
}

/// Median of a draw with replacement that took each of the sorted values so many times.
double MedianOfDrawn(std::span<const double> sorted, std::span<const int> drawn) {
  const std::size_t count = drawn.size();
  std::array<double, 2> middle{};  // the same one twice where the count is odd
  std::size_t at = 0, passed = 0;
  for (const std::size_t side : {0u, 1u}) {
    const std::size_t wanted = (count - 1 + side) / 2;
    while (passed + static_cast<std::size_t>(drawn[at]) <= wanted) {
      passed += static_cast<std::size_t>(drawn[at++]);
    }
    middle[side] = sorted[at];
  }
  return Quantile(middle, 0.5);
}

}  // namespace

Interval BootstrapMedian(std::span<const double> values, double confidence, int resamples,
                         std::uint64_t seed) {
  if (values.empty()) throw std::invalid_argument("BootstrapMedian: no values");
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  std::vector<std::size_t> place;  // of each value among the sorted
  for (const double value : values) {
    place.push_back(
        static_cast<std::size_t>(std::ranges::lower_bound(sorted, value) - sorted.begin()));
  }
  std::vector<double> medians;
  std::vector<int> drawn(values.size());  // how often, by place
  std::uint64_t n = 0;
  for (int r = 0; r < resamples; ++r) {
    std::ranges::fill(drawn, 0);
    for (std::size_t k = 0; k < values.size(); ++k) {
      ++drawn[place[Random(seed, n++) % values.size()]];
    }
    medians.push_back(MedianOfDrawn(sorted, drawn));
  }
  const double tail = (1 - confidence) / 2;
  return {Quantile(medians, tail), Quantile(medians, 1 - tail)};
}

double MannWhitneyP(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || b.empty()) return 1;
  const std::vector<int> ranks = DoubledRanks(a, b);
  return ranks.size() <= kExactLimit ? ExactP(ranks, a.size()) : NormalP(ranks, a.size());
}

std::vector<double> HolmAdjusted(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return p_values[i] < p_values[j]; });
  std::vector<double> adjusted(p_values.size());
  double highest = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto left = static_cast<double>(order.size() - k);
    highest = std::max(highest, std::min(1.0, left * p_values[order[k]]));
    adjusted[order[k]] = highest;
  }
  return adjusted;
}

double FailureRateBound(std::size_t failures, std::size_t runs, double confidence) {
  if (failures >= runs) return 1;
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    (BinomialTail(failures, runs, middle) > 1 - confidence ? low : high) = middle;
  }
  return high;
}

}  // namespace aisle
