#pragma once

#include <filesystem>
#include <string>

#include "harness/record/results.h"

namespace aisle {

/// Version, commit, processor and system of this program, here and now.
Provenance OwnProvenance();

/// The results that `run --gate` holds a suite against: reports/baselines/SUITE.json of the tree.
std::filesystem::path BaselinePath(const std::string& suite);

}  // namespace aisle
