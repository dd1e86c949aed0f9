#pragma once

#include <string>
#include <vector>

#include "harness/record/results.h"
#include "harness/score/significance.h"

namespace aisle {

/// Fewer seeds a side than this cannot reach a p that survives the correction.
inline constexpr std::size_t kFewestSeeds = 5;

/// Nine seeds a side show a shift of two standard deviations in 97 nights of 100; three never can.
struct CompareOptions {
  /// Chance of any false alarm in a whole comparison: 19 of 20 parts are for medians, one is for
  /// seeds that break, which are told by far smaller p.
  double alpha = 0.01;

  double minimum_effect = 0.1;  ///< of the old median; smaller changes are nobody's trouble
};

enum class Change {
  kBetter,
  kWorse,
  kSame,
  kWatched,     ///< time and memory belong to the machine: compared, never judged
  kCannotTell,  ///< a difference that chance may have made, or too few seeds to say
  kUnstable,    ///< some seeds got far worse while the median says nothing: a mixed distribution
  kGone,        ///< a seed had a value before, ran again and has none: nothing is left to compare
};
/// "better", "worse", "same", "watched", "cannot tell", "unstable", "gone".
std::string Name(Change change);

/// What fails a night: worse, unstable and gone.
bool IsAlarm(Change change);

/// Of the scores that are judged; of all others false.
bool MoreIsBetter(const std::string& score);

/// One score of one cell, before and after.
struct Comparison {
  std::string scene, twin, system, score, unit;
  std::size_t old_n = 0, new_n = 0;       ///< seeds compared
  std::size_t left_out = 0;               ///< seeds of one side alone, where enough are of both
  double old_median = 0, new_median = 0;  ///< NaN where no seed has a value
  Interval difference;     ///< 95 % bootstrap of the median of paired differences, new - old
  bool paired = false;     ///< same seeds on both sides: the interval is of paired differences
  bool bit_equal = false;  ///< every value the same to the last digit
  /// Seeds that got far worse: three times the error they had, a fifth less of a share (a tenth of
  /// the coverage).
  std::size_t broken = 0;
  std::string gone;    ///< the first seed whose value is missing now, and why; empty: none
  double p = 1;        ///< Mann-Whitney, Holm-corrected over the whole comparison
  double break_p = 1;  ///< of a mixed distribution (BreakP), Holm-corrected likewise
  Change change = Change::kSame;
  std::string why;
};

/// Every score that the old side has in a cell of both, coverage first: a system that stops
/// tracking has a smaller error. Scores of time and memory are compared but never called worse:
/// they belong to the machine.
std::vector<Comparison> Compare(const Results& before, const Results& after,
                                const CompareOptions& options = {});

/// Whether both were computed by one make of processor, within which equal inputs give equal bits.
/// Between makes nothing is presupposed: scores that differ are compared as any others.
bool SameProcessor(const Results& a, const Results& b);

/// What a comparison needs of a night and no more: fit to be kept under version control.
Results BaselineOf(const Results& results);

}  // namespace aisle
