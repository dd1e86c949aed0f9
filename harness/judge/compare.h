#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/record/results.h"
#include "harness/score/significance.h"

namespace aisle {

/// Fewer seeds a side than this cannot reach a p that survives the correction.
inline constexpr std::size_t kFewestSeeds = 5;

/// Nine seeds that are drawn anew each night show a shift of two standard deviations in three
/// nights of four, where nothing else differs; three never can. Seeds that keep what they have show
/// less.
struct CompareOptions {
  double alpha = 0.01;  ///< chance of any false alarm in a whole comparison

  double minimum_effect = 0.1;  ///< of the old median; smaller changes are nobody's trouble
};

/// The shares of alpha that the three families of tests may use up, each of which Holm corrects by
/// itself: cells have the most tests and the fewest seeds to each; seeds that break and systems
/// over all their cells are told by far smaller p.
inline constexpr double kAlphaOfBreaks = 0.05, kAlphaOfPooled = 0.1;
inline constexpr double kAlphaOfCells = 1 - kAlphaOfBreaks - kAlphaOfPooled;

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

/// One score of one cell, before and after; or of one system over several cells, each seed of each
/// paired with its own past (ComparePooled).
struct Comparison {
  std::string scene, twin, system, score, unit;  ///< over several cells without scene and twin
  std::size_t cells = 0;                         ///< over how many; 0: of the one that is named
  std::size_t old_n = 0, new_n = 0;              ///< seeds compared
  std::size_t left_out = 0;               ///< seeds of one side alone, where enough are of both
  double old_median = 0, new_median = 0;  ///< NaN where no seed has a value; over cells theirs'
  Interval difference;  ///< 95 % bootstrap of the median of paired differences, new - old
  /// How far it moved, new - old: the medians, and where seeds are paired the middle seed if that
  /// is less; 0 where the two disagree. Not over several cells.
  double moved = 0;
  /// What the middle one of several cells was multiplied by; empty where a factor says nothing.
  std::optional<double> factor = {};
  bool paired = false;     ///< same seeds on both sides: the interval is of paired differences
  bool bit_equal = false;  ///< every value the same to the last digit
  /// Seeds that got far worse: three times the error they had, a fifth less of a share (a tenth of
  /// the coverage).
  std::size_t broken = 0;
  std::string gone;  ///< the first seed whose value is missing now, and why; empty: none
  /// Mann-Whitney, or where seeds are paired the stronger of that and StudentP of their Worsenings;
  /// Holm-corrected over the whole comparison.
  double p = 1;
  double break_p = 1;  ///< of a mixed distribution (BreakP), Holm-corrected likewise
  Change change = Change::kSame;
  std::string why;
};

/// "SCENE TWIN SYSTEM"; "all cells of SYSTEM" of several.
std::string NameOfCell(const Comparison& comparison);

/// Every judged score of every system over the cells of both, where it has several, and then every
/// score that the old side has in a cell of both, coverage first: a system that stops tracking has
/// a smaller error. Scores of time and memory are compared but never called worse: they belong to
/// the machine.
std::vector<Comparison> Compare(const Results& before, const Results& after,
                                const CompareOptions& options = {});

/// Whether both were computed by one make of processor, within which equal inputs give equal bits.
/// Between makes nothing is presupposed: scores that differ are compared as any others.
bool SameProcessor(const Results& a, const Results& b);

/// What a comparison needs of a night and no more: fit to be kept under version control.
Results BaselineOf(const Results& results);

}  // namespace aisle
