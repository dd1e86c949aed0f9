#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// The night in at most twenty lines of plain text, each short enough for a mail: the verdict, what
/// is broken with the run to repeat, what changed and since when (`changes`, the worst first), what
/// the systems did, and where the report stands. `limits`: how many the suites set; 0: not
/// known.
std::string ToSummaryText(const Results& results, const std::vector<std::string>& changes,
                          const std::filesystem::path& report_dir, std::size_t limits = 0);

}  // namespace aisle
