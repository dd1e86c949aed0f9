#pragma once

#include <filesystem>

#include "harness/contract/run.h"

namespace aisle {

/// Copies a run's folder from one report's folder into another's, result.json last and each file
/// whole under its name: a copy that was cut off is no run, and two who copy the same run at once
/// leave it as either would have. Throws InputError where there is no such run, MachineError where
/// it cannot be written.
void CopyRun(const RunSpec& spec, const std::filesystem::path& from,
             const std::filesystem::path& to);

}  // namespace aisle
