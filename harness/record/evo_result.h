#pragma once

#include <string>

#include "harness/contract/run.h"
#include "harness/score/scorecard.h"

namespace aisle {

/// The absolute error of the run's final track as evo's own result file: what `evo_res` compares
/// and plots. Empty where there is no pose to score.
std::string EvoResultZip(const RunResult& run, const TrajectoryScore& final);

}  // namespace aisle
