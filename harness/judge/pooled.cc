#include "harness/judge/pooled.h"

#include <algorithm>
#include <cmath>

#include "harness/common/counted.h"
#include "harness/judge/judged.h"
#include "harness/judge/paired.h"
#include "harness/record/seed_values.h"
#include "harness/score/significance.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

/// What a cell's middle seed did.
struct CellShift {
  double old_median = 0, new_median = 0;
  double difference = 0;  ///< median of the paired ones, new - old
  double effect = 0;      ///< the smallest that counts
};

/// One score of one system over its cells.
struct PooledScore {
  const JudgedScore* judged = nullptr;
  Comparison comparison;
  std::vector<CellShift> cells;
  std::vector<double> worsenings;  ///< of every pair
};

void AddCell(const ValuesBySeed& before, const ValuesBySeed& after, const CompareOptions& options,
             PooledScore* pooled) {
  ValuesBySeed old_shared, new_shared;
  for (const auto& [seed, value] : before) {
    const auto at = after.find(seed);
    if (at == after.end()) continue;
    old_shared[seed] = value;
    new_shared[seed] = at->second;
  }
  if (old_shared.empty()) return;
  Comparison& comparison = pooled->comparison;
  comparison.old_n += old_shared.size();
  comparison.new_n += old_shared.size();
  comparison.bit_equal = comparison.bit_equal && old_shared == new_shared;
  const double old_median = Quantile(Plain(old_shared), 0.5);
  pooled->cells.push_back(
      {.old_median = old_median,
       .new_median = Quantile(Plain(new_shared), 0.5),
       .difference = Quantile(PairedDifferences(old_shared, new_shared), 0.5),
       .effect = SmallestEffect(*pooled->judged, options.minimum_effect, old_median)});
  std::ranges::copy(Worsenings(*pooled->judged, comparison.unit, old_shared, new_shared),
                    std::back_inserter(pooled->worsenings));
}

std::vector<double> Column(const std::vector<CellShift>& cells, double CellShift::*field) {
  std::vector<double> column;
  for (const CellShift& cell : cells) column.push_back(cell.*field);
  return column;
}

/// The middle one; of two middle ones the nearer to zero, and zero between two of different signs.
double MiddleTowardsZero(std::vector<double> values) {
  std::ranges::sort(values);
  const double low = values[(values.size() - 1) / 2], high = values[values.size() / 2];
  return low > 0 ? low : high < 0 ? high : 0;
}

/// How far the middle cell moved: as a share of its old median, or in the score's unit.
double MiddleShift(const PooledScore& pooled, bool as_share) {
  std::vector<double> shifts;
  for (const CellShift& cell : pooled.cells) {
    const double whole = as_share ? std::abs(cell.old_median) : 1;
    shifts.push_back(cell.difference == 0 ? 0 : cell.difference / whole);
  }
  return MiddleTowardsZero(std::move(shifts));
}

void Measure(PooledScore* pooled) {
  Comparison& c = pooled->comparison;
  c.cells = pooled->cells.size();
  c.paired = true;
  c.old_median = Quantile(Column(pooled->cells, &CellShift::old_median), 0.5);
  c.new_median = Quantile(Column(pooled->cells, &CellShift::new_median), 0.5);
  c.difference = BootstrapMedian(Column(pooled->cells, &CellShift::difference));
  c.p = StrongerP(SignP(pooled->worsenings), SignedRankP(pooled->worsenings));
  if (pooled->judged->smallest_effect > 0) return;
  const double share = MiddleShift(*pooled, true);
  if (std::isfinite(share)) c.factor = 1 + share;  // not of what was zero
}

std::vector<PooledScore> PoolCells(const RunsByCell& before, const RunsByCell& after,
                                   const CompareOptions& options) {
  std::map<std::string, std::vector<CellOfNight>> cells_of;  // by system
  for (const auto& [cell, runs] : after) {
    if (before.contains(cell)) cells_of[std::get<2>(cell)].push_back(cell);
  }
  std::vector<PooledScore> scores;
  for (const auto& [system, cells] : cells_of) {
    for (const JudgedScore& judged : JudgedScores()) {
      PooledScore pooled{.judged = &judged, .comparison = {}, .cells = {}, .worsenings = {}};
      Comparison& c = pooled.comparison;
      c.system = system;
      c.score = judged.score;
      c.bit_equal = true;
      for (const CellOfNight& cell : cells) {
        const ValuesBySeed old_values = ValuesOf(before.at(cell), c.score, &c.unit);
        AddCell(old_values, ValuesOf(after.at(cell), c.score, &c.unit), options, &pooled);
      }
      if (pooled.cells.size() < 2) continue;  // one speaks for itself
      Measure(&pooled);
      scores.push_back(std::move(pooled));
    }
  }
  return scores;
}

/// "24 %", or "0.03 m" where there is no factor.
std::string ShiftInWords(const PooledScore& pooled) {
  const Comparison& c = pooled.comparison;
  if (c.factor) return fmt::format("{:.3g} %", 100 * std::abs(*c.factor - 1));
  return fmt::format("{:.3g}{}", std::abs(MiddleShift(pooled, false)),
                     c.unit == "1" ? "" : " " + c.unit);
}

void Decide(const CompareOptions& options, PooledScore* pooled) {
  Comparison& c = pooled->comparison;
  const auto cells_that = [&](const auto& moved) {
    return static_cast<std::size_t>(std::ranges::count_if(pooled->cells, moved));
  };
  const std::size_t up = cells_that([](const auto& cell) { return cell.difference > cell.effect; });
  const std::size_t down =
      cells_that([](const auto& cell) { return cell.difference < -cell.effect; });
  const bool more_is_better = pooled->judged->more_is_better;
  const std::size_t worse = more_is_better ? down : up, better = more_is_better ? up : down;
  const bool is_worse = 2 * worse > c.cells, is_better = 2 * better > c.cells;
  const auto seeds = static_cast<std::size_t>(std::ranges::count_if(
      pooled->worsenings, [&](double w) { return is_better ? w < 0 : w > 0; }));
  const std::string told =
      fmt::format("{} of {} seeds got {}", seeds, c.new_n, is_better ? "better" : "worse");
  if (c.bit_equal) {
    c.change = Change::kSame;
    c.why = "equal to the last digit";
  } else if (up + down == 0) {
    c.change = Change::kSame;
    c.why = fmt::format("no cell of {} moved by more than the minimum effect", c.cells);
  } else if ((is_worse || is_better) && c.p < options.alpha) {
    c.change = is_worse ? Change::kWorse : Change::kBetter;
    c.why = fmt::format("by {} (median of {} cells); {} (p = {:.2g} after Holm)",
                        ShiftInWords(*pooled), c.cells, told, c.p);
  } else {
    c.change = Change::kCannotTell;
    c.why =
        fmt::format("{}, {} of {} cells by more than the minimum effect (p = {:.2g} after Holm)",
                    told, is_better ? better : worse, c.cells, c.p);
  }
}

}  // namespace

std::vector<Comparison> ComparePooled(const RunsByCell& before, const RunsByCell& after,
                                      const CompareOptions& options) {
  std::vector<PooledScore> scores = PoolCells(before, after, options);
  std::vector<double> p_values;
  for (const PooledScore& pooled : scores) {
    if (!pooled.comparison.bit_equal) p_values.push_back(pooled.comparison.p);
  }
  const std::vector<double> adjusted = HolmAdjusted(p_values);
  std::size_t next = 0;
  std::vector<Comparison> comparisons;
  for (PooledScore& pooled : scores) {
    Comparison& c = pooled.comparison;
    if (!c.bit_equal) c.p = std::min(1.0, adjusted[next++] / kAlphaOfPooled);
    Decide(options, &pooled);
    comparisons.push_back(std::move(c));
  }
  return comparisons;
}

}  // namespace aisle
