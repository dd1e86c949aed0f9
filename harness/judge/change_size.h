#pragma once

#include <string>
#include <vector>

#include "harness/judge/compare.h"

namespace aisle {

/// How far the median moved, over several cells their middle one's, as a factor's logarithm: the
/// same for twice as much and for half. What is gone is farther than anything.
double SizeOf(const Comparison& comparison);

/// By how much of itself the median moved, "+3.1 %"; empty where it was 0 or is gone.
std::string PercentOfChange(const Comparison& comparison);

/// Alarms first, then what got better, of both systems over all their cells before single cells;
/// then all else. Each by its size, the largest first.
void LargestFirst(std::vector<Comparison>* comparisons);

/// One seed on both sides of a comparison.
struct SeedChange {
  const RunRecord* before = nullptr;  ///< never null
  const RunRecord* after = nullptr;   ///< never null
  double old_value = 0;
  std::optional<double> new_value = {};  ///< empty: it is gone
};

/// The seed whose score moved farthest in the direction of the medians, where some seeds got far
/// worse (kUnstable) to the worse; one whose value is gone, first. Nothing where no seed ran on
/// both sides, and of several cells. The pointers lead into the results.
std::optional<SeedChange> FarthestSeed(const Results& before, const Results& after,
                                       const Comparison& comparison);

/// Why two nights have nothing to compare, in a sentence; empty where they share a cell.
std::string WhyNothingShared(const Results& before, const Results& after);

}  // namespace aisle
