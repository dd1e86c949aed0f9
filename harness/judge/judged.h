#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/record/seed_values.h"

namespace aisle {

/// A score that may raise an alarm, and which way it is good.
struct JudgedScore {
  const char* score;
  bool more_is_better = false;
  double smallest_effect = 0;  ///< in its unit, where a share of the old median is too coarse
};

/// Coverage first: a system that stops tracking has a smaller error.
std::span<const JudgedScore> JudgedScores();

/// Null for a score that is not judged.
const JudgedScore* FindJudged(const std::string& score);

/// The smallest change that is anybody's trouble, in the score's unit.
double SmallestEffect(const JudgedScore& judged, double minimum_effect, double old_median);

/// Whether a seed went far beyond what it was: three times the error it had, a fifth less of a
/// share (a tenth of the coverage). `unit` is the score's.
bool IsFarWorse(const JudgedScore& judged, const std::string& unit, double before, double after);

/// How bad a value is, on a scale on which scatter is a factor: errors and what a share lacks grow
/// as their logarithms, but for differences that are nobody's trouble; clearances shrink likewise.
double Badness(const JudgedScore& judged, const std::string& unit, double value);

/// By how much each seed of both got worse (Badness), in the order of the seeds: of errors the
/// logarithm of their ratio. Below zero it got better.
std::vector<double> Worsenings(const JudgedScore& judged, const std::string& unit,
                               const ValuesBySeed& before, const ValuesBySeed& after);

/// New minus old of each seed of both, in the score's unit and the order of the seeds.
std::vector<double> PairedDifferences(const ValuesBySeed& before, const ValuesBySeed& after);

}  // namespace aisle
