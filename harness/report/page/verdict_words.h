#pragma once

#include <string>

#include "harness/record/results.h"

namespace aisle {

/// The score a verdict is about: what stands behind its last colon, up to a space.
std::string ScoreOf(const Verdict& verdict);

/// "6 of 6 verdicts failed (2 limits, in 3 cells)": how many there are and what of, as a limit is
/// judged in every scene, twin and system that it speaks of. `limits`: how many the suites set; 0:
/// not known. Empty where nothing was judged.
std::string VerdictsInWords(const std::vector<Verdict>& verdicts, std::size_t limits);

}  // namespace aisle
