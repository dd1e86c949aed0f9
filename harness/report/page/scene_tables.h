#pragma once

#include <string>
#include <vector>

#include "harness/record/group.h"

namespace aisle {

// The tables of a scene's page: a row per system, medians over seeds.

/// Errors, coverage, features and time. Where some runs have no value the median is of the others,
/// marked with how many those are.
std::string ErrorTable(const std::vector<SystemRuns>& systems);

/// What was rejected and how movers were followed; empty where no system rejects anything.
std::string MaskTables(const std::vector<SystemRuns>& systems);

/// How a vehicle fared that they steered.
std::string DriveTable(const std::vector<SystemRuns>& systems);

/// Every score of every run, folded away.
std::string AllScores(const SceneRuns& scene);

}  // namespace aisle
