#pragma once

#include <string>

#include "harness/record/results.h"

namespace aisle {

/// A line per run: scene, twin, system, seed, status and every score.
std::string ToSummaryCsv(const Results& results);

}  // namespace aisle
