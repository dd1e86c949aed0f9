#pragma once

#include <string>
#include <vector>

#include "harness/record/results.h"
#include "harness/score/significance.h"

namespace aisle {

/// Nine seeds a side show a shift of two standard deviations in 97 nights of 100; three never can.
struct CompareOptions {
  double alpha = 0.01;          ///< chance of any false alarm in a whole comparison
  double minimum_effect = 0.1;  ///< of the old median; smaller changes are nobody's trouble
};

enum class Change {
  kBetter,
  kWorse,
  kSame,
  kWatched,     ///< time and memory belong to the machine: compared, never judged
  kCannotTell,  ///< a difference that chance may have made, or too few seeds to say
};
/// "better", "worse", "same", "watched", "cannot tell".
std::string Name(Change change);

/// One score of one cell, before and after.
struct Comparison {
  std::string scene, twin, system, score, unit;
  std::size_t old_n = 0, new_n = 0;  ///< seeds
  double old_median = 0, new_median = 0;
  Interval difference;     ///< 95 % bootstrap of the median of paired differences, new - old
  bool paired = false;     ///< same seeds on both sides: the interval is of paired differences
  bool bit_equal = false;  ///< every value the same to the last digit
  double p = 1;            ///< Mann-Whitney, Holm-corrected over the whole comparison
  Change change = Change::kSame;
  std::string why;
};

/// Every score that both sides have, coverage first: a system that stops tracking has a smaller
/// error. Scores of time and memory are compared but never called worse: they belong to the
/// machine.
std::vector<Comparison> Compare(const Results& before, const Results& after,
                                const CompareOptions& options = {});

/// Whether both were computed by one make of processor, within which equal inputs give equal bits.
/// Between makes nothing is presupposed: scores that differ are compared as any others.
bool SameProcessor(const Results& a, const Results& b);

/// What a comparison needs of a night and no more: fit to be kept under version control.
Results BaselineOf(const Results& results);

/// A failed verdict for each score that got worse, and for each cell that is gone.
std::vector<Verdict> GateVerdicts(const Results& before, const Results& after,
                                  const CompareOptions& options = {});

}  // namespace aisle
