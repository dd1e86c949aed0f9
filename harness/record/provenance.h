#pragma once

#include <filesystem>
#include <string>

#include "harness/record/results.h"

namespace aisle {

/// Version, commit, processor and system of this program, here and now.
Provenance OwnProvenance();

/// Folder of the baselines that come with the program.
std::filesystem::path ShippedBaselines();

/// The results that `run --gate` holds a suite against: reports/baselines/SUITE.json of the tree;
/// of an installed program the user's own, else the one that came with it.
std::filesystem::path BaselinePath(const std::string& suite);

/// Where `baseline` puts new ones: the tree's, or the user's own.
std::filesystem::path NewBaselinePath(const std::string& suite);

}  // namespace aisle
