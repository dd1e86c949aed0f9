#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/results.h"

namespace aisle {

/// The verdicts, and the runs that came to their end, as CI servers read them: every verdict a test
/// case, its numbers in the failure's message; below it the commands that repeat the very runs it
/// is about and what a foreign system said last. `report_dir` is where the runs lie.
std::string ToJunit(const Results& results, const std::filesystem::path& report_dir = ".");

/// The runs that a verdict is about: of its scene, twin and system; one that failed, alone.
std::vector<const RunRecord*> RunsOf(const Verdict& verdict, const Results& results);

/// What a failed verdict is told with, some lines: why, which runs to repeat how, last words.
std::string FailureText(const Verdict& verdict, const Results& results,
                        const std::filesystem::path& report_dir);

}  // namespace aisle
