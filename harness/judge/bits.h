#pragma once

#include <string>
#include <vector>

#include "harness/record/record.h"

namespace aisle {

/// Scores of two runs that differ and should not: all but times and memory, which belong to the
/// machine. A score that one of them lacks differs. One line each; empty for equal bits; the same
/// scores whichever run is named first.
std::vector<std::string> DifferentBits(const RunRecord& a, const RunRecord& b);

}  // namespace aisle
