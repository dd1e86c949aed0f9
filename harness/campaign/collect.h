#pragma once

#include <filesystem>
#include <vector>

#include "harness/record/results.h"
#include "harness/suite/plan.h"

namespace aisle {

struct CollectOptions {
  /// Hold the suites' limits against the runs. A part of a suite is judged once it is merged.
  bool judge_limits = true;
};

/// The results that the folder holds for these runs of the plan, judged: each suite's limits
/// against the runs of that suite. A run without a result fails a verdict of its own: silence is no
/// pass.
Results Collect(const PlanFile& plan, const std::vector<RunSpec>& specs,
                const std::filesystem::path& out, const CollectOptions& options = {});

}  // namespace aisle
