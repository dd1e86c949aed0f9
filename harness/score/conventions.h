#pragma once

#include <string>
#include <vector>

#include "harness/score/align.h"

namespace aisle {

/// What an estimate that disagrees with the truth would agree with it as: its poses inverted, its
/// lengths in another unit or of no known scale, its quaternions in the other order. A sentence for
/// each; empty where it agrees as it stands, or as none of these. It changes no score.
std::vector<std::string> NotesOnConventions(const Trajectory& truth, const Trajectory& estimate,
                                            const std::vector<PosePair>& pairs,
                                            AlignmentMethod alignment);

}  // namespace aisle
