#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/judge/cell.h"
#include "harness/record/results.h"

namespace aisle {

/// The seeds that a night has of each cell.
std::map<CellOfNight, std::set<std::uint64_t>> SeedsByCell(const Results& results);

/// What one night has of a scene, twin and system, and another has not.
struct MissingRuns {
  std::string scene, twin, system;
  std::vector<std::uint64_t> seeds;
  bool is_whole = false;  ///< the other has nothing of this scene, twin and system
};

/// What `before` has and `after` lacks: scores that are not there get no worse. A run that failed
/// is there; that its scores are not is told of each (Change::kGone), as of a repeat that is not.
std::vector<MissingRuns> MissingRunsOf(const Results& before, const Results& after);

/// "2 cells and 4 seeds of 1 other are missing"; empty where nothing is.
std::string InWords(const std::vector<MissingRuns>& missing);

/// The ids of the runs that did not come to their end, or that were planned and are not there.
std::vector<std::string> UnfinishedRuns(const Results& results,
                                        const std::vector<RunSpec>& planned);

}  // namespace aisle
