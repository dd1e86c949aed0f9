#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/report/record.h"
#include "harness/report/verdict.h"

namespace aisle {

/// Which program on which machine made the numbers.
struct Provenance {
  std::string version, commit;
  std::string cpu, os;
  int threads = 0;
};

/// A whole evening: what results.json holds and every report is made from.
struct Results {
  Provenance provenance;
  std::string suite;
  std::string question;  ///< what the suite asks, one sentence
  std::string started;   ///< UTC, ISO 8601
  std::string rerun;     ///< the command line that made it
  double wall_s = 0;
  std::vector<RunRecord> runs;
  std::vector<Verdict> verdicts;
};

bool AllPassed(const Results& results);

std::string ToJson(const Results& results);
/// Throws InputError when the text is no results.json of a known schema.
Results ResultsFromJson(const std::string& text, const std::string& file);
Results ReadResults(const std::filesystem::path& report_dir);

/// JUnit for CI: one suite, a test case per verdict, numbers in the failure text. Control bytes
/// that XML cannot hold are dropped.
std::string ToJunit(const Results& results);

/// Fixed-width table for people; `color` adds ANSI colours.
std::string ToConsole(const Results& results, bool color);

/// A line per run: scene, twin, system, seed, status and every score.
std::string ToSummaryCsv(const Results& results);

}  // namespace aisle
