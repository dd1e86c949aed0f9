#pragma once

#include <vector>

#include "slam/optimize/bundle.h"

namespace aisle::slam {

/// Bundle adjustment by Levenberg and Marquardt's method with the points eliminated and what is
/// left decomposed as a dense matrix: for windows of up to some hundred free poses, of which nearly
/// all see something in common. See Solve.
BundleSummary SolveWindow(BundleProblem& problem, const std::vector<bool>& active,
                          const BundleOptions& options);

}  // namespace aisle::slam
