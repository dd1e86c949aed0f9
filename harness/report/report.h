#pragma once

#include <filesystem>

#include "harness/record/results.h"

namespace aisle {

/// Writes results.json, summary.csv, junit.xml, index.html with style.css and a page per scene into
/// the folder; the runs' own files must be there already. Nothing is scored again.
void WriteReport(const Results& results, const std::filesystem::path& report_dir);

}  // namespace aisle
