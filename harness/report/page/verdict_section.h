#pragma once

#include <map>
#include <string>
#include <tuple>

#include "harness/record/group.h"
#include "harness/record/results.h"
#include "harness/report/page/page.h"

namespace aisle {

/// Since when something is as it is: a few words of markup for each scene, twin, system and score.
using SinceNotes =
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::string>;

/// The answer in words and the verdict; what is broken, the worst first, leads to its scene and
/// says since when; `limits` as VerdictsInWords has it. A night whose runs failed is no good night,
/// limits or not.
std::string VerdictSection(const Results& results, const std::vector<SceneRuns>& scenes,
                           SceneLinks links, const SinceNotes& since, std::size_t limits);

}  // namespace aisle
