#include "harness/judge/paired.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "harness/score/significance.h"

namespace aisle {
namespace {

/// The chance that Student's t of so many degrees of freedom lies farther from zero than this one.
/// With t = sqrt(freedom) * cot(phi), the density over phi from 0 to pi is a power of its sine: no
/// difference of near equals, however small the chance.
double BeyondT(double t, double freedom) {
  const auto area = [&](double to) {  // Simpson's rule
    constexpr int kSteps = 200;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight * std::pow(std::sin(to * i / kSteps), freedom - 1);
    }
    return sum * to;
  };
  return area(std::atan2(std::sqrt(freedom), std::abs(t))) / area(std::numbers::pi / 2);
}

std::vector<double> WithoutZeros(std::span<const double> differences) {
  std::vector<double> rest(differences.begin(), differences.end());
  std::erase(rest, 0.0);
  return rest;
}

/// The ranks of their sizes, ties by mid-ranks: twice, so that they are whole numbers.
std::vector<std::size_t> DoubledRanksOfSize(std::span<const double> differences) {
  std::vector<double> sizes;
  for (const double difference : differences) sizes.push_back(std::abs(difference));
  std::vector<double> sorted = sizes;
  std::ranges::sort(sorted);
  std::vector<std::size_t> ranks;
  for (const double size : sizes) {
    const auto below = std::ranges::lower_bound(sorted, size) - sorted.begin();
    const auto through = std::ranges::upper_bound(sorted, size) - sorted.begin();
    ranks.push_back(static_cast<std::size_t>(below + through + 1));
  }
  return ranks;
}

/// Share of all ways to give the ranks signs whose positive sum lies at least as far from the mean.
double ExactP(std::span<const std::size_t> ranks, std::size_t observed, std::size_t total) {
  std::vector<double> ways(total + 1, 0.0);  // doubles hold these counts well enough
  ways[0] = 1;
  for (const std::size_t rank : ranks) {
    for (std::size_t sum = total; sum >= rank; --sum) ways[sum] += ways[sum - rank];
  }
  const std::size_t far = std::max(observed, total - observed);
  double extreme = 0;
  for (std::size_t sum = far; sum <= total; ++sum) extreme += ways[sum];
  return std::min(1.0, 2 * extreme / std::exp2(static_cast<double>(ranks.size())));
}

double NormalP(std::span<const std::size_t> ranks, std::size_t observed, std::size_t total) {
  double squares = 0;
  for (const std::size_t rank : ranks) squares += static_cast<double>(rank * rank);
  const double far = std::abs(static_cast<double>(observed) - static_cast<double>(total) / 2) - 1;
  return std::min(1.0, std::erfc(std::max(far, 0.0) / std::sqrt(squares / 2)));
}

}  // namespace

double StudentP(std::span<const double> differences) {
  constexpr double kLeastSpread = 0.05;
  if (differences.size() < 2) return 1;
  const auto n = static_cast<double>(differences.size());
  double mean = 0, squares = 0;
  for (const double difference : differences) mean += difference / n;
  for (const double difference : differences) squares += (difference - mean) * (difference - mean);
  const double spread = std::max(kLeastSpread, std::sqrt(squares / (n - 1)));
  return BeyondT(mean / (spread / std::sqrt(n)), n - 1);
}

double SignP(std::span<const double> differences) {
  std::size_t above = 0, below = 0;
  for (const double difference : differences) {
    above += difference > 0;
    below += difference < 0;
  }
  const std::size_t all = above + below;
  const auto n = static_cast<double>(all);
  double p = 0;
  for (std::size_t k = std::max(above, below); k <= all; ++k) {
    const auto i = static_cast<double>(k);
    p += 2 * std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) -
                      n * std::numbers::ln2);
  }
  return std::min(1.0, p);
}

double SignedRankP(std::span<const double> differences) {
  const std::vector<double> rest = WithoutZeros(differences);
  if (rest.empty()) return 1;
  const std::vector<std::size_t> ranks = DoubledRanksOfSize(rest);
  std::size_t above = 0, total = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    total += ranks[i];
    above += rest[i] > 0 ? ranks[i] : 0;
  }
  return rest.size() <= kExactLimit ? ExactP(ranks, above, total) : NormalP(ranks, above, total);
}

double StrongerP(double one, double other) { return std::min(1.0, 2 * std::min(one, other)); }

}  // namespace aisle
