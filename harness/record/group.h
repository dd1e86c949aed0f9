#pragma once

#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// All runs of one system on one version of one scene: they differ by seed.
struct SystemRuns {
  std::string system;
  int color = 0;  ///< the same for a system all over the report
  std::vector<const RunRecord*> runs;
};

/// All runs on one version of one scene: what belongs into the same charts.
struct SceneRuns {
  std::string scene, twin;
  std::vector<SystemRuns> systems;
};

/// In the order of the runs. The pointers lead into `results`.
std::vector<SceneRuns> GroupByScene(const Results& results);

/// Median over the runs that have the score; absent if one of them has not.
std::optional<double> MedianScore(const std::vector<const RunRecord*>& runs,
                                  const std::string& score);

}  // namespace aisle
