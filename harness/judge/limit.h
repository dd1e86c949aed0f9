#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// A bound on a score, from a suite file. Empty filters match everything.
struct Limit {
  std::string score;
  std::string scene = {}, twin = {}, system = {};
  std::optional<double> min = {}, max = {};
  /// The share of the seeds that must hold the bound, each by itself; absent: their median must.
  std::optional<double> share = {};
};

/// Crashed, timed-out and invalid runs, limits or not.
std::vector<Verdict> JudgeRuns(const std::vector<RunRecord>& runs);

/// One verdict per limit and per scene, twin and system it speaks of: the median over seeds held
/// against the bound, where a score that is absent in any run fails; or, with a share, each seed,
/// where one whose score is absent in any of its runs does not hold. A seed that ran several times
/// counts once in the median, by that of its repeats. The verdict's limit is the bound that its
/// value breaks, where it holds both the nearer one. A median passes what befalls fewer than half:
/// right for errors, wrong for goals and contacts. A limit that matches no run
/// fails too: it would otherwise pass for ever.
std::vector<Verdict> JudgeLimits(const std::vector<RunRecord>& runs,
                                 const std::vector<Limit>& limits);

/// Both, for runs that one set of limits speaks of.
std::vector<Verdict> Judge(const std::vector<RunRecord>& runs, const std::vector<Limit>& limits);

bool AllPassed(const Results& results);

}  // namespace aisle
