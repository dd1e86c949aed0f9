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

/// Files what the run `from` left as the answer of another run of the same report: all but its job,
/// under the other's name, with a note that says whose drive it was. For runs of equal inputs; the
/// other is in `hall`. Throws as CopyRun does.
void CopyRunAs(const RunSpec& from, const RunSpec& to, const std::string& hall,
               const std::filesystem::path& report_dir);

}  // namespace aisle
