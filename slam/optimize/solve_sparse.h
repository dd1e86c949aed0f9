#pragma once

#include <vector>

#include "slam/optimize/bundle.h"

namespace aisle::slam {

/// Bundle adjustment by Ceres' sparse Schur complement: for whole maps, where most poses have
/// nothing in common. See Solve.
BundleSummary SolveSparse(BundleProblem& problem, const std::vector<bool>& active,
                          const BundleOptions& options);

}  // namespace aisle::slam
