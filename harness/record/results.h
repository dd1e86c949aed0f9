#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/record.h"
#include "harness/record/verdict.h"

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
  /// The first of the suite and scene files that it was made of; empty in results of before.
  std::string suite_file = {};
  double wall_s = 0;
  std::vector<RunRecord> runs;
  std::vector<Verdict> verdicts;
};

std::string ToJson(const Results& results);
/// Throws InputError when the text is no results.json of a known schema.
Results ResultsFromJson(const std::string& text, const std::string& file);
Results ReadResults(const std::filesystem::path& report_dir);

}  // namespace aisle
