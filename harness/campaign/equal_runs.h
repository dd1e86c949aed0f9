#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/campaign/job.h"

namespace aisle {

/// Whether a run is decided by what its frames show and its system is. Foreign systems see the
/// scene's name as well and may scatter, and repeats ask just that: those are driven each time.
bool IsOnlyItsInputs(const RunSpec& spec);

/// Jobs, and which of them are answered by another's drive: of equal inputs come equal bits. The
/// `empty` twins of scenes that differ in actors alone are such.
struct EqualRuns {
  std::vector<Job> driven;
  std::map<std::string, std::vector<Job>> answered;  ///< by the RunId of the one that is driven
};
EqualRuns GroupEqual(const std::vector<Job>& jobs);

/// Whether one drive may answer for both.
bool AreEqual(const Job& a, const Job& b);

/// Files the finished run of `from` as the answer of `to`, its equal; false, and nothing done,
/// where it did not end well.
bool AnswerFrom(const Job& from, const Job& to);

}  // namespace aisle
