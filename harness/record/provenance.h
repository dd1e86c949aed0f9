#pragma once

#include <filesystem>
#include <string>

#include "harness/record/results.h"

namespace aisle {

/// Version, commit, processor and system of this program, here and now.
Provenance OwnProvenance();

/// Program, commit and processor of this process into the record of a run that it made.
void SayWhoMadeIt(RunRecord* record);

/// Of a night: commits and processors of its runs, joined where there are several; what no run
/// says, and the rest, from this program here.
Provenance ProvenanceOf(const std::vector<RunRecord>& runs);

/// Folder of the baselines that come with the program.
std::filesystem::path ShippedBaselines();

/// The results that `run --gate` holds a suite against: reports/baselines/SUITE.json of the tree;
/// of an installed program the user's own, else the one that came with it.
std::filesystem::path BaselinePath(const std::string& suite);

/// Where `baseline` puts new ones: the tree's, or the user's own.
std::filesystem::path NewBaselinePath(const std::string& suite);

}  // namespace aisle
