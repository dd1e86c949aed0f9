#pragma once

#include <span>

namespace aisle {

// Two-sided p of paired differences: how likely it is that they lie so far to one side of zero,
// were nothing changed. 1 where there are none, or none but zeros.

/// Of Student's t: the mean of a normal distribution, whose spread the differences show. A spread
/// below a twentieth counts as one: nine ratios that are alike to the last digit are no proof
/// without bound. 1 for fewer than two.
double StudentP(std::span<const double> differences);

/// Of the sign test, exact: each as likely above zero as below. No more is supposed of how they
/// scatter. Zeros are left out.
double SignP(std::span<const double> differences);

/// Of Wilcoxon's signed-rank test (1945): distributed alike on both sides of zero. Exact, ties by
/// mid-ranks, up to kExactLimit differences; beyond that the normal approximation with tie and
/// continuity correction. Zeros are left out.
double SignedRankP(std::span<const double> differences);

/// The p of two tests of one question, of which the stronger counts (Bonferroni).
double StrongerP(double one, double other);

}  // namespace aisle
