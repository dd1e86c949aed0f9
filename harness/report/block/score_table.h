#pragma once

#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// A row for each system on each version of each scene, in the order of the runs; a column for each
/// of these scores: the median over seeds and, where there are several, the least and the most.
/// Throws InputError, naming it, for a score that no run has.
std::string ScoreTable(const Results& results, const std::vector<std::string>& scores);

}  // namespace aisle
