#pragma once

#include <optional>
#include <string>

#include "harness/score/associate.h"

namespace aisle {

/// By what the estimate's stamps must be multiplied to be those of the truth: a power of 1000 from
/// 1e-9 to 1e9 by which four fifths of the shorter file find a partner. Absent where as they stand
/// half of it did (`pairs`), or none of them does so.
std::optional<double> StampFactor(const Trajectory& truth, const Trajectory& estimate,
                                  const std::vector<PosePair>& pairs);

/// "with the estimate's stamps times 0.001, …: is one of the files in milliseconds?"
std::string NoteOnStamps(double factor);

}  // namespace aisle
