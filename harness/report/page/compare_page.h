#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/judge/compare.h"

namespace aisle {

/// One of two nights that are held against each other.
struct ComparedNight {
  std::string name;              ///< as the user called it
  const Results* results;        ///< never null
  std::filesystem::path folder;  ///< of its report; empty for a results file alone
};

/// What changed between two nights: both by name, date, commit, machine and command; what of the
/// one is missing in the other; the changes by their size, each with its scene, the seed that moved
/// farthest, and that seed's frames before and after, which are copied below `out`. Or why there is
/// nothing to compare.
std::string ComparePage(std::vector<Comparison> comparisons, const ComparedNight& before,
                        const ComparedNight& after, const std::filesystem::path& out);

}  // namespace aisle
