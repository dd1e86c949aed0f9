#pragma once

#include <string>
#include <vector>

#include "harness/judge/compare.h"

namespace aisle {

/// The name of the verdict that counts cells of a night which the baseline has not.
inline constexpr const char* kWithoutBaseline = "gate: cells without a baseline";

/// A verdict for every score that is judged, of each system over all its cells and of each cell,
/// failed where it got worse, is unstable or is gone; a failed one for each cell, and each seed of
/// a cell, that the baseline has and the night has not; and one that is passed but says so where
/// the night has cells that the baseline has not.
std::vector<Verdict> GateVerdicts(const Results& baseline, const Results& night,
                                  const CompareOptions& options = {});

/// Why a night of these runs can only fail at the gate, and what would help: empty where it has
/// every cell and seed of the baseline.
std::string BoundToFail(const Results& baseline, const std::vector<RunSpec>& night);

/// What a gate against this baseline cannot see for want of seeds, in a sentence; empty where every
/// cell has enough.
std::string BlindFor(const Results& baseline);

}  // namespace aisle
