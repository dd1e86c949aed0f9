#pragma once

#include <filesystem>
#include <vector>

#include "harness/record/results.h"
#include "harness/suite/suite.h"

namespace aisle {

struct CollectOptions {
  /// Hold the suite's limits against the runs. A part of a suite is judged once it is merged.
  bool judge_limits = true;
};

/// The results that the folder holds for these runs, judged. A run without a result fails a verdict
/// of its own: silence is no pass.
Results Collect(const Suite& suite, const std::vector<RunSpec>& specs,
                const std::filesystem::path& out, const CollectOptions& options = {});

struct PublishOptions {
  bool json = false;     ///< results.json on stdout instead of the table
  bool remember = true;  ///< file the medians with those of other nights
  int failure = 0;       ///< exit code of what failed on our side, if anything did
};

/// Writes the report, tells the user and returns the exit code.
int Publish(const Results& results, const std::filesystem::path& out,
            const PublishOptions& options = {});

}  // namespace aisle
