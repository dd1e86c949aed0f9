#pragma once

#include <string>

#include "harness/contract/run.h"
#include "harness/score/scorecard.h"

namespace aisle {

/// The run's absolute error as evo's own result file: what `evo_res` compares and plots. Empty
/// where there is no pose to score.
std::string EvoResultZip(const RunResult& run, const ScoreOptions& options = {});

}  // namespace aisle
