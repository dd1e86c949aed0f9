#pragma once

#include <filesystem>

#include "harness/record/results.h"

namespace aisle {

/// Writes a folder of Allure results (one JSON file a test, version 2 of its model): the verdicts
/// and the runs that came to their end, the same as in junit.xml, so that the CI shows the history
/// beside each of them. A test keeps its historyId from night to night; what failed carries the
/// commands that repeat its runs, the last words, the log and the worst frame. Made anew: what an
/// earlier night left there is taken away, as the plug-ins expect.
void WriteAllure(const Results& results, const std::filesystem::path& report_dir,
                 const std::filesystem::path& into);

}  // namespace aisle
