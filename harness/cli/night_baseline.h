#pragma once

#include <filesystem>

#include "harness/record/results.h"

namespace aisle {

// What a night is held against lies beside its plan as baseline.json, so that parts made on other
// machines, or the tasks of a cluster, are judged by whoever makes one night of them.

void WriteNightBaseline(const Results& baseline, const std::filesystem::path& out);
/// Throws InputError where there is none.
Results ReadNightBaseline(const std::filesystem::path& out);

/// Adds the gate's verdicts.
void HoldAgainstBaseline(const Results& baseline, Results* results);

}  // namespace aisle
