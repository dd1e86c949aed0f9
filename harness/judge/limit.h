#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// A bound on a score, from a suite file. Empty filters match everything.
struct Limit {
  std::string score;
  std::string scene, twin, system;
  std::optional<double> min, max;
};

/// One verdict per limit and per scene, twin and system it speaks of: the median over seeds held
/// against the bound; a score that is absent in any run fails. A limit that matches no run fails
/// too: it would otherwise pass for ever. Crashed, timed-out and invalid runs fail by themselves,
/// limits or not.
std::vector<Verdict> Judge(const std::vector<RunRecord>& runs, const std::vector<Limit>& limits);

bool AllPassed(const Results& results);

}  // namespace aisle
